#include "base/shared_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decimals.h"

namespace gapscope {

SharedUnit::SharedUnit(double first, const std::string& unit) : unit_(unit.empty() ? "" : " " + unit) {
  static constexpr std::array kPrefixes = {"", "m", "µ", "n"};
  const double size = std::abs(first);
  if (unit.empty() || !(size > 0.0) || !std::isfinite(size) || unit.starts_with("unit") || unit == "duty")
    return;  // no "milliunit of u", no "mduty"
  const double thousands = std::clamp(std::ceil(-std::log10(size) / 3.0 - 1e-12), 0.0, 3.0);
  factor_ = std::pow(10.0, 3.0 * thousands);
  unit_ = std::string(" ") + kPrefixes[static_cast<std::size_t>(thousands)] + unit;
}

std::string SharedUnit::number(double value) const {
  const double shown = value * factor_;
  const bool whole = std::abs(shown) >= 999.5;                                  // never "1.2e+03"
  return whole ? with_decimals(shown, 0) : fmt::format("{:.3g}", shown + 0.0);  // no sign of a zero
}

std::string SharedUnit::interval_after(double value, const Interval& ci95, const char* before,
                                       const char* after) const {
  const double half = factor_ * (ci95.high - ci95.low) / 2.0;
  if (!(half > 0.0)) return (*this)(value);
  const int d = static_cast<int>(std::clamp(1.0 - std::floor(std::log10(half)), 0.0, 6.0));
  return fmt::format("{}{}{}95 %: {} to {}{}", with_decimals(factor_ * value, d), unit_, before,
                     with_decimals(factor_ * ci95.low, d), with_decimals(factor_ * ci95.high, d), after);
}

std::string SharedUnit::with_interval(double value, const Interval& ci95) const {
  return interval_after(value, ci95, ", ", "");
}

std::string SharedUnit::with_interval_aside(double value, const Interval& ci95) const {
  return interval_after(value, ci95, " (", ")");
}

}  // namespace gapscope
