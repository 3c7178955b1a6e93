#pragma once

#include <vector>

#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// Spreads the correcting torque of a model over mode, direction, speed, angle, input, frequency and time,
/// and puts into words what stands out against an error that is everywhere alike.
/// @param effect that was found to explain it; nullptr: none
/// @param band_hz  top of the band to which the torque is low-passed first: that of the error budget, so that
/// the
///   missing torque's place and its size are of one and the same; NaN: there is no budget
MismatchPlace place_of(const std::vector<Playback>& playbacks, const HeldOut& held_out,
                       double torque_constant, Coordinates coordinates, const ModelEffect* effect,
                       double band_hz = kNaN);

}  // namespace gapscope::internal::diagnosis
