#pragma once

#include <string>
#include <vector>

#include "gapscope/results/run_result.h"
#include "report/figure_data.h"

namespace gapscope::internal::report {

/// The figures in order, each with its reading; what there is none of, with the reason.
std::string figure_section(const std::vector<FigureData>& figures);

/// A heading and a list; nothing for no lines.
std::string bullet_section(const char* title, const std::vector<std::string>& lines);

/// The text of report.md: findings, table of estimates, figures in order with their readings, notes,
/// warnings.
std::string report_text(const RunResult& run, const Timing& timing, const std::vector<FigureData>& figures);

}  // namespace gapscope::internal::report
