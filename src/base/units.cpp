#include "gapscope/base/units.h"

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

std::string shown_unit(const std::string& unit, bool rotation) {
  if (unit == "-") return "";
  const std::string text = axis_unit(unit, rotation);
  return replaced(replaced(text, "N m", "N·m"), "^2", "²");
}

}  // namespace gapscope
