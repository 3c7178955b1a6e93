#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"

namespace gapscope::internal::report {

/// Draws the figures into a folder, each as its PNG, and writes report.md beside them; removes those of an
/// earlier result that are missing now.  @throws std::runtime_error naming what cannot be written.
void write_report_files(const std::string& folder, const std::vector<FigureData>& figures,
                        const std::string& text);

}  // namespace gapscope::internal::report
