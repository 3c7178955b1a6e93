#pragma once

#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// Adds to the floors what half a step of a supply's readings moves: a servo that tells its voltage in steps
/// of a percent leaves its torque open by as much, and no model can come closer. It is the rms difference of
/// the innovations and the free runs of `model` between the input as it is read and as it may have been: half
/// a step more or less, drawn anew with each change of the reading. Nothing where no supply is told.
/// @returns whether there is any
bool add_supply_steps(const ReferenceModel& model, double observer_hz, HeldOut& held_out);

}  // namespace gapscope::internal::diagnosis
