#pragma once

#include <string>

namespace gapscope {

/// Draws all figures (PNG) and report.md of a result folder from what is stored in it.
/// @throws ConfigError when the folder holds no result; std::runtime_error when a file cannot be written.
void write_report(const std::string& folder);

}  // namespace gapscope
