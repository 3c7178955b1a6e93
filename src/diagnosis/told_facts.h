#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

/// What the numbers of a diagnosis come to, for those who decide by it and those who tell it.
namespace gapscope::internal::diagnosis {

/// Whether the recordings leave it open that there is none of an effect: of no number that says how much
/// there is of it zero is outside the 95 % interval. (A knee or a stiffness is without a bound where the
/// effect is absent: the interval of its inverse holds zero where its own does.) A number without an interval
/// has ended at a bound of its search, or the fit does not determine it: then only the torque balance can
/// show it. A coarser count is read, not fitted.
bool may_be_absent(const AddedEffect& effect, const Diagnosis& diagnosis);

/// Whether the period of a torque or an encoder's error that repeats with the angle, where it was searched,
/// is longer than any held-out motion: what does not come round once may be anything that bends over the
/// travel.
bool outlasts_motion(const AddedEffect& effect, const Diagnosis& diagnosis);

/// By how much of itself a number has moved; a phase by how much of a turn.
double moved_by(const RefittedNumber& number);

/// The variable that a law of last resort, or an effect, is a function of; "" for an effect of another kind.
std::string variable_of(const EffectEntry& entry);

}  // namespace gapscope::internal::diagnosis
