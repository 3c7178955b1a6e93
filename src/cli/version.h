#pragma once

namespace gapscope::cli {

inline constexpr const char* kVersion = GAPSCOPE_VERSION;

}  // namespace gapscope::cli
