#include "recording/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "gapscope/base/errors.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
namespace {

/// Number of grid points that fit between the first and the last row.
std::size_t grid_size(const RecordedRows& table, double rate) {
  const double intervals = (table.t.back() - table.t.front()) * rate;
  if (intervals > static_cast<double>(kMostSamples))
    throw ConfigError(table.path, fmt::format("resampling to {} Hz gives {:.3g} samples, expected at most {}",
                                              rate, intervals, kMostSamples));
  // Straight lines between the rows tell nothing new, at the cost of as many rows more: 10 refuses a burst
  // of rows in a log of events, 1000 takes hours.
  constexpr double kMostPerRow = 100.0;
  const auto rows = static_cast<double>(table.size());
  if (intervals > kMostPerRow * rows)
    throw ConfigError(
        table.path, fmt::format("resampling to {} Hz gives {:.3g} samples of {} rows, expected at most {} a "
                                "row, which is up to {:.4g} Hz",
                                rate, intervals, table.size(), kMostPerRow,
                                kMostPerRow * rows / (table.t.back() - table.t.front())));
  return static_cast<std::size_t>(std::floor(intervals * (1.0 + 1e-12))) + 1;
}

/// The grid never leaves the rows, but for the rounding of its last point.
std::vector<double> linearly(const RecordedRows& table, const std::vector<double>& values,
                             const Recording& grid, std::size_t count) {
  std::vector<double> out;
  if (values.empty()) return out;
  out.reserve(count);
  std::size_t row = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = std::clamp(grid.time(i), table.t.front(), table.t.back());
    while (row + 2 < table.size() && table.t[row + 1] <= t) ++row;
    const double part = (t - table.t[row]) / (table.t[row + 1] - table.t[row]);
    out.push_back(values[row] + part * (values[row + 1] - values[row]));
  }
  return out;
}

/// ū_i = 1/dt ∫ u dt from t_i to t_{i+1}, u held from its own row to the next, the last one for ever.
std::vector<double> interval_means(const RecordedRows& table, const Recording& grid, std::size_t count) {
  std::vector<double> out;
  out.reserve(count);
  std::size_t row = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double begin = grid.time(i), end = grid.time(i + 1);
    while (row + 1 < table.size() && table.t[row + 1] <= begin) ++row;
    double impulse = 0.0, from = begin;
    for (; row + 1 < table.size() && table.t[row + 1] < end; ++row) {
      impulse += table.u[row] * (table.t[row + 1] - from);
      from = table.t[row + 1];
    }
    // One row over the whole interval keeps its own number, free of rounding.
    out.push_back(from == begin ? table.u[row] : (impulse + table.u[row] * (end - from)) / (end - begin));
  }
  return out;
}

std::string note(const RecordedRows& table, double rate) {
  double shortest = table.t[1] - table.t[0], longest = shortest;
  for (std::size_t i = 1; i < table.size(); ++i) {
    shortest = std::min(shortest, table.t[i] - table.t[i - 1]);
    longest = std::max(longest, table.t[i] - table.t[i - 1]);
  }
  const double mean = (table.t.back() - table.t.front()) / static_cast<double>(table.size() - 1);
  return fmt::format(
      "resampled from {:.5g} Hz on average (steps of {:.4g} to {:.4g} ms) to {:.5g} Hz: positions linearly, "
      "input as the mean over each new interval",
      1.0 / mean, 1e3 * shortest, 1e3 * longest, rate);
}

}  // namespace

Recording resample(const RecordedRows& table, double rate) {
  GAPSCOPE_REQUIRE(rate > 0.0 && table.size() >= 2);
  const std::size_t count = grid_size(table, rate);
  Recording r;
  r.start = table.t.front();
  r.dt = 1.0 / rate;
  r.x1 = linearly(table, table.x1, r, count);
  r.x2 = linearly(table, table.x2, r, count);
  r.u = interval_means(table, r, count);
  r.resampling = note(table, rate);
  return r;
}

}  // namespace gapscope::internal::recording
