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

/// Whether the name says, too, what is measured in a unit of one letter.
bool says_quantity(std::string_view column, char unit) {
  const char* quantity = unit == 'A' ? "current" : unit == 'V' ? "volt" : unit == 'N' ? "force" : nullptr;
  const std::vector<std::string> words = words_of(column);
  return quantity != nullptr && std::any_of(words.begin(), words.end(), [&](const std::string& word) {
           return word.starts_with(quantity);
         });
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

std::string unit_in_name(std::string_view column, Quantity quantity) {
  const bool bracketed = column.ends_with(']') || column.ends_with(')');
  const std::size_t before = column.find_last_of(bracketed ? "[(" : "_ ");
  if (before == column.npos) return "";
  std::string_view unit = column.substr(before + 1);
  if (bracketed) unit.remove_suffix(1);
  if (unit.empty() || std::isdigit(static_cast<unsigned char>(unit.front())) != 0) return "";
  if (!bracketed && unit.size() == 1 && !says_quantity(column, unit.front())) return "";
  return unit_scale(quantity, unit) ? std::string(unit) : "";
}

}  // namespace gapscope
