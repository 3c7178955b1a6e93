#pragma once

#include <cstddef>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// Samples over which the slope of x1 is taken as the speed: 20 ms, odd, at least nine.
std::size_t speed_window(const MotorTrace& recording);

/// Position and speed at the first sample, with the speed's standard error, from a cubic over as many
/// samples as one fits.
struct LocalMotion {
  double x = 0.0, w = 0.0, w_std = 0.0;
};
/// @param floor  standard deviation of a position [rad]
LocalMotion local_motion(const MotorTrace& recording, double floor);

}  // namespace gapscope::internal::signals
