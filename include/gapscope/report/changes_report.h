#pragma once

#include <string>

#include "gapscope/report/figure_formats.h"
#include "gapscope/results/drive_changes.h"

namespace gapscope {

/// What each report says of each quantity and how it differs from the first one: for a terminal.
std::string changes_text(const DriveChanges& changes);

/// Draws the figure (PNG) and report.md of a comparison from its compare.json alone.
/// @throws ConfigError where there is none; std::runtime_error when a file cannot be written.
void write_changes_report(const std::string& folder, const FigureFormats& formats = {});

}  // namespace gapscope
