#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "inspection/column_guess.h"
#include "recording/column_name.h"

namespace gapscope::test {

constexpr int kLogRows = 300;
constexpr double kLogStep = 0.01;  // [s]

inline double input_at(int i) { return 0.5 * std::cos(0.07 * i); }
inline double position_at(int i) { return 0.3 * std::sin(0.05 * i); }

/// Rows of a text, each made of its number.
inline std::string lines(const std::function<std::string(int)>& line, int count = kLogRows) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line(i) + "\n";
  return text;
}

/// t, u, x1 with these marks between and within them.
inline std::string plain(int i, const std::string& separator = ",", char decimal = '.') {
  std::string text =
      fmt::format("{:.4f}{}{:.8f}{}{:.8f}", kLogStep * i, separator, input_at(i), separator, position_at(i));
  for (char& c : text) c = c == '.' ? decimal : c;
  return text;
}

inline std::string clock(int i, const char* form) {
  const int ms = i * 10;
  return fmt::format(fmt::runtime(form), ms / 60000, ms / 1000 % 60, ms % 1000);
}

inline std::string values(int i) { return fmt::format(",{:.8f},{:.8f}", input_at(i), position_at(i)); }

/// As `check` and `init` read a file of which nothing, or only a rate, is told.
inline Recording as_seen(const std::string& path, double rate, ColumnGuess declared,
                         std::vector<std::string>& codes) {
  const ColumnGuess seen = guess_columns(path, std::move(declared), rate > 0.0);
  ReadOptions options;
  RecordingColumns& c = options.columns;
  c.time = seen.time, c.input = seen.input, c.rate = rate;
  c.position = seen.position.empty() ? seen.speed : seen.position;
  c.position_is_speed = seen.position.empty();
  const auto scale = [](Quantity q, const std::string& unit, const std::string& column) {
    return unit_scale(q, unit.empty() ? unit_in_name(column, q) : unit).value_or(UnitScale{});
  };
  c.scales.time = scale(Quantity::kTime, seen.time_unit, c.time);
  c.scales.input = scale(Quantity::kTorque, seen.input_unit, c.input);
  c.scales.position = c.position_is_speed ? scale(Quantity::kTurning, seen.speed_unit, c.position)
                                          : scale(Quantity::kAngle, seen.position_unit, c.position);
  options.uneven = UnevenRows::kStamped;
  const Recording r = read_recording(path, options);
  for (const Remark& remark : seen.told) codes.push_back(remark.code());
  for (const Remark& remark : r.assumed) codes.push_back(remark.code());
  return r;
}

inline const std::string kUsualNames = "t,u,x1\n";

}  // namespace gapscope::test
