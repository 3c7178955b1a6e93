#include "gapscope/base/coordinates.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"

namespace gapscope {

std::string Coordinates::unit(const std::string& rotational_unit) const {
  if (rotational()) return rotational_unit;
  if (rotational_unit == "torque") return torque_word();
  return replaced(replaced(replaced(rotational_unit, "kg m^2", "kg"), "N m", "N"), "rad", "m");
}

std::string Coordinates::shown_unit(const std::string& rotational_unit) const {
  if (rotational_unit == "-") return "";
  return replaced(replaced(unit(rotational_unit), "N m", "N·m"), "^2", "²");
}

std::string Coordinates::with_units(const std::string& words) const {
  std::string out;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = words.find('[', at), close = words.find(']', open);
    if (close == words.npos) return out + words.substr(at);
    const std::string inside = words.substr(open + 1, close - open - 1);
    const bool is_unit = inside.find('{') == inside.npos;
    out += words.substr(at, open - at) + (is_unit ? unit(inside) : "[" + inside + "]");
    at = close + 1;
  }
  return out;
}

std::string Coordinates::thousandths(double position) const {
  if (std::isnan(position)) return "-";
  const bool large = std::abs(position) >= 9.9995;  // never "1.5e+04 mrad"
  return large ? fmt::format("{:.4g} {}", position, position_unit())
               : fmt::format("{:.4g} m{}", 1e3 * position, position_unit());
}

}  // namespace gapscope
