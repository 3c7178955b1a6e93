#pragma once

#include <vector>

#include "torque_view/laws.h"

/// The grids of shapes that laws are tried at, each in rising order; empty where a law has no place.
namespace gapscope::internal::torque_view {

std::vector<double> no_shape(const Scales& scales);
std::vector<double> motor_turn(const Scales& scales);
std::vector<double> load_turn(const Scales& scales);
std::vector<double> only_held(const Scales& scales);
std::vector<double> low_speeds(const Scales& scales);
std::vector<double> lengths(const Scales& scales);
std::vector<double> dead_zones(const Scales& scales);
std::vector<double> powers(const Scales& scales);
std::vector<double> step_times(const Scales& scales);
std::vector<double> spans(const Scales& scales);
std::vector<double> resonances(const Scales& scales);
std::vector<double> found_line(const Scales& scales);
std::vector<double> found_ripple(const Scales& scales);
std::vector<double> only_known(const Scales& scales);
std::vector<double> top_speed(const Scales& scales);

}  // namespace gapscope::internal::torque_view
