#pragma once

#include <span>
#include <vector>

#include "sliding_mode/one_body.h"

namespace gapscope::internal::sliding_mode {

/// What the motor would do if a share of a body's inertia were a load behind a gap, without dry friction of
/// its own, and struck without a rebound. Of all loads of its inertia such ones show least: dry friction
/// takes them out of step with the motor.
/// @param law    of both together, whose dry friction is the motor's
/// @param ratio  of load and motor inertia   @param gap  [rad]
/// @param slows  the load alone, its viscous friction [1/s]; the motor has the rest
/// @param v      speed of both at first [rad/s]   @param u  held over each interval   @param dt  [s]
/// @returns x1 at the begin of each interval, from 0 [rad]
std::vector<double> motion_with_light_load(const OneBodyLaw& law, double ratio, double slows, double gap,
                                           double v, std::span<const double> u, double dt);

}  // namespace gapscope::internal::sliding_mode
