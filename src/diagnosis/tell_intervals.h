#pragma once

#include "diagnosis/fitted_model.h"
#include "diagnosis/study.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// Gives the numbers of what was added, and the gap of the model, the 95 % intervals that the fit of the
/// training recordings leaves them, where it determines them, and tells which of the configured numbers lie
/// outside of theirs. They hold for the model with all that was added in it.
/// @param nominal  as fitted; a number that a torque balance has held there is not told as refitted
void tell_intervals(const Study& study, const FittedModel& fitted, const ReferenceModel& nominal,
                    Diagnosis& diagnosis);

}  // namespace gapscope::internal::diagnosis
