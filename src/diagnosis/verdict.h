#pragma once

#include "diagnosis/further.h"
#include "diagnosis/last_resort.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// What the searches come to: effects that are causes, what helps, or a law of last resort for what none of
/// them explains.
/// @param explains false: what was added leaves the motion unexplained
Diagnosis verdict_on(const Study& study, const Findings& found, const Additions& added,
                     const TorqueSearch& ladder, bool explains);

/// Whether a free-form law on top of effects is of a variable of theirs: they are a part of a function of it.
bool continues_one(const LawSearch& law, const Additions& added);

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

/// Leaves causes open that the recordings do not determine: an effect that may be absent, and with effects
/// that bring the held-out motion no nearer the torque that they take is paid for elsewhere. Where that is
/// the first one, they help at most.
void open_undetermined(Coordinates coordinates, Diagnosis& d);

/// What a search that was asked to finish before its end may say: it names no cause away from the floor,
/// since neither further steps nor laws of last resort had their turn. The torque balance has seen its end.
void tell_stopped(const Study& study, const Additions& added, bool by_balance, Diagnosis& d);

}  // namespace gapscope::internal::diagnosis
