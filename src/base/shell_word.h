#pragma once

#include <string>

namespace gapscope {

/// A path as a shell takes it for one word, the name of a file and no option: in quotes where it needs them.
std::string shell_word(const std::string& path);

}  // namespace gapscope
