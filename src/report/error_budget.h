#pragma once

#include <string>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// The error budget as a waterfall: what each law takes of the missing torque, down to the floors.
FigureData diagnosis_budget(const DiagnosisResult& result);

/// Whether its laws were added where the candidates' own refits begin with another effect: then these did not
/// decide.
bool budget_decides(const Diagnosis& diagnosis);

/// What each of its laws takes alone, and beside all the others.
Panel budget_shares(const DiagnosisResult& result);

/// The waterfall as a table; nothing for a drive that has none.
std::string budget_table(const DiagnosisResult& result);

}  // namespace gapscope::internal::report
