#include "recording/row_clock.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace gapscope::internal::recording {
namespace {

constexpr double kDay = 86400.0;
constexpr std::size_t kLongNumber = 16;  ///< digits from which on a double has lost the last of them

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_long_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.size() >= kLongNumber && text.size() <= 19 && std::all_of(text.begin(), text.end(), is_digit);
}

/// Takes a number off the front.
std::optional<double> taken(std::string_view& text) {
  double value = 0.0;
  const auto [end, problem] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (problem != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

bool RowClock::reads(std::string_view text) { return text.find(':') != text.npos || is_long_number(text); }

/// Hours, minutes and, where they are there, seconds with a decimal point or comma, or milliseconds behind a
/// third colon; "PM" behind them. Of two parts the last is in seconds where it has decimals ("01:02.500").
std::optional<double> RowClock::of_day(std::string_view text) {
  std::size_t at = text.find(':');
  if (at == text.npos || at == 0) return {};
  while (at > 0 && is_digit(text[at - 1])) --at;
  std::string clock(text.substr(at));
  std::replace(clock.begin(), clock.end(), ',', '.');
  std::string_view left = clock;
  const std::size_t second = clock.find(':') + 1, decimals = clock.find('.');
  const bool without_hours = clock.find(':', second) == clock.npos && decimals < clock.find(' ', second);
  double seconds = 0.0, unit = without_hours ? 60.0 : 3600.0;
  for (int part = 0; part < 3; ++part, unit /= 60.0) {
    const auto value = taken(left);
    if (!value || (part > 0 && *value >= 61.0)) return {};
    seconds += *value * unit;
    if (!left.starts_with(':') || part == 2) break;
    left.remove_prefix(1);
  }
  if (left.starts_with(':')) {
    left.remove_prefix(1);
    seconds += taken(left).value_or(0.0) / 1000.0;  // "10:00:00:125"
  }
  const bool late = left.find("PM") != left.npos || left.find("pm") != left.npos;
  const bool early = left.find("AM") != left.npos || left.find("am") != left.npos;
  if ((late || early) && seconds >= 0.5 * kDay)
    seconds -= 0.5 * kDay;  // 12:30 is half past noon, or midnight
  return late ? seconds + 0.5 * kDay : seconds;
}

std::optional<double> RowClock::seconds(std::string_view text, double unit) {
  if (is_long_number(text)) {
    std::int64_t value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc()) return {};
    if (!begun_) begun_ = true, origin_ = value;
    return static_cast<double>(value - origin_) * unit;
  }
  const auto now = of_day(text);
  if (!now) return {};
  if (!begun_) begun_ = true, first_ = last_ = *now;
  days_ += *now < last_ - 0.5 * kDay ? kDay : *now > last_ + 0.5 * kDay ? -kDay : 0.0;
  last_ = *now;
  return std::round((*now - first_ + days_) * 1e9) / 1e9;  // as many decimals as stamps have
}

}  // namespace gapscope::internal::recording
