#pragma once

#include "gapscope/recording/controller.h"

namespace gapscope::internal::recording {

/// When a drive was let go that comes to rest far off its goal, falling from where it was held [s]; infinite
/// where it is held to the end. A weak controller under a load rests far off its goal as well. What tells
/// them apart is the motion itself: a torque in proportion to the error that ends then leaves less of it
/// unexplained than one that goes on, beside damping, friction and a load that turns with the position:
///   ẍ = a e 1[t < t_off] − b ẋ − c sgn ẋ + d sin x + f cos x
double let_go_at(const CommandRows& rows);

}  // namespace gapscope::internal::recording
