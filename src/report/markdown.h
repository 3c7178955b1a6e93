#pragma once

#include <string>
#include <vector>

#include "gapscope/results/run_result.h"
#include "report/figure_data.h"

namespace gapscope::internal {

/// The text of report.md: findings, table of estimates, figures in order with their readings, notes,
/// warnings.
std::string report_text(const RunResult& run, const Timing& timing, const std::vector<FigureData>& figures);

}  // namespace gapscope::internal
