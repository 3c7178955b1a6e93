#pragma once

#include "diagnosis/further.h"
#include "diagnosis/last_resort.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// What the searches come to: effects that are causes, what helps, or a law of last resort for what none of
/// them explains.
/// @param explains false: what was added leaves the motion unexplained
Diagnosis verdict_on(const Study& study, const FirstSearch& found, const Additions& added,
                     const TorqueSearch& ladder, bool explains);

/// Whether a free-form law on top of effects is of a variable of theirs: they are a part of a function of it.
bool continues_one(const LawSearch& law, const Additions& added);

/// Leaves causes open that the recordings do not determine: an effect that may be absent, and with effects
/// that bring the held-out motion no nearer the torque that they take is paid for elsewhere. Where that is
/// the first one, they help at most.
void open_undetermined(Diagnosis& d);

/// What a search that was asked to finish before its end may say: it names no cause away from the floor,
/// since neither further steps nor laws of last resort had their turn. The torque balance has seen its end.
void tell_stopped(const Additions& added, bool by_balance, Diagnosis& d);

}  // namespace gapscope::internal::diagnosis
