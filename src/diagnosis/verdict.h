#pragma once

#include "diagnosis/further.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// What the searches come to: effects that are causes, what helps, or a law of last resort for what none of
/// them explains.
/// @param explains false: what was added leaves the motion unexplained
Diagnosis verdict_on(const Study& study, const Findings& found, const Additions& added,
                     const TorqueSearch& ladder, bool explains);

}  // namespace gapscope::internal::diagnosis
