#include "gapscope/recording/column_name.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace gapscope {
namespace {

/// The words of "Motor_tempCoil2": "motor", "temp", "coil".
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  bool small = false;  // the last letter was
  for (const char letter : name) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalpha(c) == 0 || (small && std::isupper(c) != 0)) words.emplace_back();
    if (std::isalpha(c) != 0) words.back() += static_cast<char>(std::tolower(c));
    small = std::islower(c) != 0;
  }
  return words;
}

}  // namespace

bool says_temperature(std::string_view column) {
  for (const std::string_view unit : {"°C", "°F", "℃", "℉", "degC", "degF"}) {
    const std::size_t at = column.find(unit), behind = at + unit.size();
    if (at == column.npos) continue;
    if (behind == column.size() || std::isalpha(static_cast<unsigned char>(column[behind])) == 0) return true;
  }
  const std::vector<std::string> words = words_of(column);
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "temp" || word == "temps" || word.starts_with("temperatur") || word == "celsius" ||
           word == "fahrenheit" || word == "kelvin";
  });
}

}  // namespace gapscope
