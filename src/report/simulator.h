#pragma once

#include <string>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// Drive, user's simulator and fitted model over one another, the two differences below.
FigureData diagnosis_simulator(const DiagnosisResult& result);

/// The table of drive and simulator; empty where there is no simulator.
std::string simulator_table(const DiagnosisResult& result);

}  // namespace gapscope::internal::report
