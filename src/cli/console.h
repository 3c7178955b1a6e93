#pragma once

#include <string>
#include <vector>

#include "gapscope/campaign/pipeline.h"

namespace gapscope::cli {

/// Progress on standard error, and only on a terminal.
Progress progress_on_terminal(bool quiet);

void print_warnings(const std::vector<std::string>& warnings);

/// The headline of a run on standard output: the report, both estimates with intervals, and how they compare.
void print_headline(const std::string& folder, const RunResult& result);

}  // namespace gapscope::cli
