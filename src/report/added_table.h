#pragma once

#include <string>

#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// A harmonic that is not there, or a period that is the once per turn.
bool is_left_out(const NamedValue& p);

/// The section of report.md on what was added: the numbers of each effect with its interval, and what the
/// recordings cannot tell from it. Empty where nothing was added.
std::string added_table(const DiagnosisResult& r);

}  // namespace gapscope::internal::report
