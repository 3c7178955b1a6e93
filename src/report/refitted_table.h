#pragma once

#include <string>

#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// The section of report.md on the numbers that the configuration gives and the recordings contradict, with
/// those that were fitted; empty where there are none.
std::string refitted_table(const DiagnosisResult& r);

}  // namespace gapscope::internal::report
