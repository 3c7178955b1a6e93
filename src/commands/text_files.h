#pragma once

#include <string>
#include <vector>

namespace gapscope {

/// A text that a command leaves in its folder.
struct TextFile {
  std::string name;
  std::string text;
};

/// @throws std::runtime_error naming what cannot be written
void write_texts(const std::string& folder, const std::vector<TextFile>& files);

}  // namespace gapscope
