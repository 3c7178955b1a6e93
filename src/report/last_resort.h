#pragma once

#include <string>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// The correcting torque over the variable that it is a function of, by direction, with the fitted law drawn
/// through it, and what the law leaves.
FigureData diagnosis_law(const DiagnosisResult& result);

/// What the laws of last resort take, and where their tables are.
std::string law_table(const DiagnosisResult& result);

}  // namespace gapscope::internal::report
