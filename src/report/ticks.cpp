#include "report/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

Ticks ticks_of_step(double low, double high, double step, int power) {
  Ticks ticks{step, std::max(0, -power), {}};
  const double slack = 1e-9 * (high - low);  // a limit that is a multiple of the step keeps its tick
  const double first = std::ceil((low - slack) / step), last = std::floor((high + slack) / step);
  for (double k = first; k <= last; k += 1.0) ticks.values.push_back(k == 0.0 ? 0.0 : k * step);
  return ticks;
}

}  // namespace

Ticks round_ticks(double low, double high, int most) {
  if (!(high > low)) return {1.0, 0, {low}};
  int power = static_cast<int>(std::floor(std::log10((high - low) / most))) - 1;
  Ticks finer;
  for (;; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double step = digit * std::pow(10.0, power);
      if ((high - low) / step > 2.5 * most + 1.0) continue;  // not even the finer ones of a single tick
      Ticks ticks = ticks_of_step(low, high, step, power);
      const bool single = ticks.values.size() < 2 && finer.values.size() > 1;
      if (static_cast<int>(ticks.values.size()) <= most) return single ? finer : ticks;
      finer = std::move(ticks);
    }
  }
}

std::vector<Place> log_places(const Interval& range, std::initializer_list<double> multiples) {
  std::vector<Place> places;
  for (int decade = static_cast<int>(std::floor(range.low)); decade <= range.high; ++decade)
    for (const double m : multiples) {
      const double at = decade + std::log10(m);
      if (at >= range.low && at <= range.high)
        places.push_back({at, typeset(fmt::format("{:g}", m * std::pow(10.0, decade)))});
    }
  return places;
}

std::string tick_label(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return (value < 0.0 && !is_zero ? "−" : "") + text;
}

AxisScale axis_scale(const std::string& unit, double magnitude) {
  static constexpr const char* kScaled[] = {"rad", "m", "s", "N·m", "N", "rad/s", "m/s"};
  const bool scaled = std::find(std::begin(kScaled), std::end(kScaled), unit) != std::end(kScaled);
  if (!scaled || !(magnitude > 0.0) || magnitude >= 1.0) return {1.0, unit};
  static constexpr const char* kPrefixes[] = {"m", "µ", "n", "p"};
  const int thousands = std::clamp(static_cast<int>(std::ceil(-std::log10(magnitude) / 3.0 - 1e-12)), 1, 4);
  return {std::pow(10.0, -3 * thousands), kPrefixes[thousands - 1] + unit};
}

}  // namespace gapscope::internal::report
