#pragma once

#include <span>

#include "gapscope/recording/controller.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {

/// The drive under a controller that reads its encoder: an update takes the reading of its own moment, its
/// output acts `delay` later, and the drive moves exactly from one of these moments to the next. u is the
/// mean of what acted in each interval, `command` what it was made of.
/// @param target  held from sample to sample [rad], of a controller of the speed [rad/s]
/// @throws std::runtime_error when the motion diverges.
Recording simulate_under_controller(const PlantModel<double>& model, const DriveController& controller,
                                    std::span<const double> target, const SimulationOptions& options);

}  // namespace gapscope
