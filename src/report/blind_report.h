#pragma once

#include <string>

#include "report/figure_formats.h"

namespace gapscope {

/// Draws all figures (PNG) and report.md of a blind check from its blind.json alone.
/// @throws ConfigError where there is none; std::runtime_error when a file cannot be written.
void write_blind_report(const std::string& folder, const FigureFormats& formats = {});

}  // namespace gapscope
