#pragma once

#include <string>

#include "report/figure_formats.h"
#include "results/drive_changes.h"

namespace gapscope {

/// What each report says of each quantity and how it differs from the first one: for a terminal.
std::string changes_text(const DriveChanges& changes);

/// A table of reports of several axes of a machine, or of several units of one drive: a quantity a line, and
/// how far they lie apart beside how far a fit of one of them is uncertain. For a terminal.
std::string spread_text(const DriveChanges& changes);

/// Draws the figure (PNG) and report.md of a comparison from its compare.json alone.
/// @throws ConfigError where there is none; std::runtime_error when a file cannot be written.
void write_changes_report(const std::string& folder, const FigureFormats& formats = {});

}  // namespace gapscope
