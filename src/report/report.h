#pragma once

#include <string>

#include "report/figure_formats.h"

namespace gapscope {

/// Draws all figures (PNG) and report.md of a result folder from what is stored in it.
/// @param note  a sentence to stand below the title, e.g. on what an earlier report had
/// @throws ConfigError when the folder holds no result; std::runtime_error when a file cannot be written.
void write_report(const std::string& folder, const std::string& note = "", const FigureFormats& formats = {});

}  // namespace gapscope
