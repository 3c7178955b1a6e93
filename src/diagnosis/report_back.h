#pragma once

#include "diagnosis/further.h"

namespace gapscope::internal::diagnosis {

/// Puts the findings into the public result: sizes, ranking, places, blame, traces, words.
Diagnosis report_back(const Study& study, const Findings& found, const Additions& added);

}  // namespace gapscope::internal::diagnosis
