#pragma once

#include <string>

#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "support/temporary_file.h"

namespace gapscope::testing {

/// Rows t, u, x1 at 1 kHz.
inline std::string rows(int count, const std::string& end = "\n") {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += std::to_string(0.001 * i) + "," + std::to_string(i % 7) + "," + std::to_string(0.01 * i) + end;
  return text;
}

/// What is said of a CSV with that text, from its name on.
inline std::string refusal(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFile file(text);
  try {
    read_recording(file.path(), options);
  } catch (const ConfigError& error) {
    return std::string(error.what()).substr(file.folder().string().size() + 1);
  }
  return "(accepted)";
}

}  // namespace gapscope::testing
