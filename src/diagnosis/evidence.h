#pragma once

#include "diagnosis/diagnose.h"
#include "gapscope/diagnosis/evidence.h"

namespace gapscope::internal::diagnosis {

StepEvidence evidence_of(const Study& study, const FirstSearch& found);

}  // namespace gapscope::internal::diagnosis
