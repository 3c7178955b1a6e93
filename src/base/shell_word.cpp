#include "base/shell_word.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/text.h"

namespace gapscope {

std::string shell_word(const std::string& path) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("._-/").find(c) != std::string_view::npos;
  };
  const std::string word = path.starts_with('-') ? "./" + path : path;
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  return "'" + replaced(word, "'", "'\\''") + "'";
}

}  // namespace gapscope
