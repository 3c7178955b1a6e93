#include "gapscope/base/units.h"

#include <regex>

namespace gapscope {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string axis_unit(const std::string& unit, bool rotation) {
  if (rotation) return unit;
  return replaced(replaced(replaced(unit, "kg m^2", "kg"), "N m", "N"), "rad", "m");
}

std::string axis_sentence(const std::string& text, bool rotation) {
  if (rotation) return text;
  static const std::regex unit(
      R"(([0-9]) (kg m\^2|N m( s(\^2)?)?(/rad(\^2)?)?|rad(/s(\^2|²)?)?)(?![A-Za-z]))");
  std::string out;
  auto rest = text.cbegin();
  for (std::sregex_iterator m(text.begin(), text.end(), unit), end; m != end; ++m) {
    out.append(rest, (*m)[2].first);
    out += axis_unit((*m)[2], rotation);
    rest = (*m)[2].second;
  }
  return out.append(rest, text.cend());
}

std::string shown_unit(const std::string& unit, bool rotation) {
  if (unit == "-") return "";
  const std::string text = axis_unit(unit, rotation);
  return replaced(replaced(text, "N m", "N·m"), "^2", "²");
}

}  // namespace gapscope
