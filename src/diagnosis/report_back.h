#pragma once

#include "diagnosis/further.h"

namespace gapscope::internal::diagnosis {

/// Puts the findings into the public result: sizes, ranking, places, blame, traces, words.
Diagnosis report_back(const Study& study, const FirstSearch& found, const Additions& added);

/// The same of what the torque balance has led to.
Diagnosis report_ladder(const Study& study, const FirstSearch& found, const TorqueSearch& ladder);

/// The same of a first candidate that shrinks the held-out error while its cause is open.
Diagnosis report_help(const Study& study, const FirstSearch& found);

}  // namespace gapscope::internal::diagnosis
