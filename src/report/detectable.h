#pragma once

#include <string>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// What of each effect would have been named: the torque that the smallest amount makes, as a share of the
/// input's, on a logarithmic axis, with the amount beside each bar.
FigureData diagnosis_detectable(const DiagnosisResult& result);

/// The same as a sentence and a table; nothing where nobody asked for it.
std::string detectable_table(const DiagnosisResult& result);

}  // namespace gapscope::internal::report
