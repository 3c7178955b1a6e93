#pragma once

#include <optional>

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Positions of a model under the drive's controller: each recording that is held out begins where the model
/// fits it best, and goes on under the controller alone. Empty where the recordings have no command; one
/// whose motion diverges is empty alone.
Positions runs_under_controller(const Study& study, const ReferenceModel& model);

/// How far they are off, without and with what was added. Nothing where there are none.
std::optional<ClosedLoop> judged_under_controller(const HeldOut& held_out, const Positions& before,
                                                  const Positions& after);

/// Each recording that is held out beside the fitted model, and how well the nominal one fits it.
std::vector<HeldOutRun> held_out_runs(const Study& study, const ReferenceModel& nominal,
                                      const ReferenceModel& fitted);

/// Gives a diagnosis what the model does from the first sample of each recording on, freely, and under the
/// controller where there is one, and its traces the latter of both.
/// @param added  whether the fitted model has more than the nominal one
void tell_whole_runs(const Study& study, const ReferenceModel& nominal, bool added, Diagnosis& diagnosis);

}  // namespace gapscope::internal::diagnosis
