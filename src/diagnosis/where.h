#pragma once

#include <span>
#include <vector>

#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// Spreads the correcting torque of a model over mode, direction, speed, angle, input, frequency and time,
/// and puts into words what stands out against an error that is everywhere alike.
/// @param effect that was found to explain it; nullptr: none
MismatchPlace place_of(const std::vector<Playback>& playbacks, const HeldOut& held_out,
                       double torque_constant, Coordinates coordinates, const ModelEffect* effect);

}  // namespace gapscope::internal::diagnosis
