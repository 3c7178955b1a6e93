#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace gapscope::testing {

/// Where the real recordings are: $GAPSCOPE_DATA, else beside the checkout. They are not part of the project.
inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("GAPSCOPE_DATA")) return folder;
  return std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "../shared/data";
}

}  // namespace gapscope::testing

/// Skips the running test where the real recordings are absent.
#define GAPSCOPE_NEEDS_DATA()                                              \
  if (!std::filesystem::exists(gapscope::testing::data_folder() / "emps")) \
  GTEST_SKIP() << "no real recordings in " << gapscope::testing::data_folder() << " (set GAPSCOPE_DATA)"
