#pragma once

#include <concepts>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "gapscope/base/errors.h"

namespace gapscope::testing {

/// All that a file holds.
inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// What is wrong with the input, in the words of the action; empty where it takes it.
template <std::invocable Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace gapscope::testing
