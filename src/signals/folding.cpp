#include "signals/folding.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "signals/period.h"

namespace gapscope::internal::signals {
namespace {

constexpr std::size_t kFewestPeriods = 3;
constexpr double kDithered =
    2.0;  ///< variance between periods, over that of rounding, from which on noise dithers

/// x1 by period and phase.
struct PeriodTable {
  double length = 0.0;                    ///< of a period [samples]
  double begin = 0.0;                     ///< of the first one [samples]
  std::vector<std::vector<double>> rows;  ///< one per period, equally spaced phases [rad]
  std::vector<double> offsets;            ///< their means, removed [rad]
  std::size_t phases() const { return rows.front().size(); }
};

/// Every sample in its bin, carried to the middle of it along the local slope.
void place_samples(const MotorTrace& trace, PeriodTable& table) {
  const std::size_t n = trace.size(), bins = table.phases(), reach = std::max<std::size_t>(2, bins / 400);
  const double width = table.length / static_cast<double>(bins);
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = (static_cast<double>(i) - table.begin) / table.length;
    if (phase < 0.0 || phase >= static_cast<double>(table.rows.size())) continue;
    const auto row = static_cast<std::size_t>(phase);
    const double place = (phase - static_cast<double>(row)) * static_cast<double>(bins);
    const auto bin = std::min(static_cast<std::size_t>(place), bins - 1);
    const std::size_t left = i - std::min(i, reach), right = std::min(i + reach, n - 1);
    const double slope = (trace.x1[right] - trace.x1[left]) / static_cast<double>(right - left);
    table.rows[row][bin] = trace.x1[i] + slope * (static_cast<double>(bin) + 0.5 - place) * width;
  }
}

/// A bin without a sample (the phases are a little finer than the samples) takes the mean of its neighbours.
void fill_gaps(std::vector<double>& row) {
  for (std::size_t b = 0; b < row.size(); ++b) {
    if (!std::isnan(row[b])) continue;
    const double left = b > 0 ? row[b - 1] : kNaN, right = b + 1 < row.size() ? row[b + 1] : kNaN;
    row[b] = std::isnan(left) ? right : std::isnan(right) ? left : 0.5 * (left + right);
  }
}

PeriodTable tabulate(const MotorTrace& trace, double length) {
  PeriodTable table;
  table.length = length;
  const auto last = static_cast<double>(trace.size() - 1);
  const auto whole = static_cast<std::size_t>(last / length);
  table.begin = last - static_cast<double>(whole) * length;
  table.rows.assign(whole, std::vector<double>(static_cast<std::size_t>(std::lround(length)), kNaN));
  place_samples(trace, table);
  for (auto& row : table.rows) {
    fill_gaps(row);
    table.offsets.push_back(mean(row));
    for (double& value : row) value -= table.offsets.back();
  }
  return table;
}

/// Standard deviation of one of two periods, from their difference.
double spread(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(0.5 * sum / static_cast<double>(a.size()));
}

/// The last periods agree best; earlier ones are taken while they do.
std::size_t first_settled(const PeriodTable& table, double quantum) {
  const auto& rows = table.rows;
  const double settled = std::max(spread(rows[rows.size() - 1], rows[rows.size() - 2]), quantum / 3.0);
  std::size_t first = rows.size() - 2;
  while (first > 0 && spread(rows[first - 1], rows.back()) < 2.0 * settled) --first;
  return first;
}

/// What the motion gains from one period to the next [rad].
double drift_of(const PeriodTable& table, std::size_t first) {
  return (table.offsets.back() - table.offsets[first]) / static_cast<double>(table.rows.size() - first - 1);
}

/// Mean of the periods from `first` on; the variance between them, of one sample [rad²].
double average(const PeriodTable& table, std::size_t first, std::vector<double>& average) {
  const auto k = static_cast<double>(table.rows.size() - first);
  average.assign(table.phases(), 0.0);
  double scatter = 0.0;
  for (std::size_t b = 0; b < average.size(); ++b) {
    double sum = 0.0, square = 0.0;
    for (std::size_t r = first; r < table.rows.size(); ++r)
      sum += table.rows[r][b], square += table.rows[r][b] * table.rows[r][b];
    average[b] = sum / k;
    scatter += (square - sum * sum / k) / (k - 1.0);
  }
  return scatter / static_cast<double>(average.size());
}

}  // namespace

MotorTrace FoldedMotion::trace(const std::string& file) const {
  return {file, start, dt, tiled_u, tiled_x1, 0.0};
}

FoldedMotion fold(const MotorTrace& trace) {
  FoldedMotion f;
  const double period = exact_period(trace, static_cast<double>(kFewestPeriods + 1));
  if (period <= 0.0) return f;
  PeriodTable table = tabulate(trace, period / trace.dt);
  f.quantum = encoder_quantum(trace);
  const std::size_t first = first_settled(table, f.quantum);
  if (table.rows.size() - first < kFewestPeriods) return f;
  f.periods = table.rows.size() - first;
  f.dt = period / static_cast<double>(table.phases());
  f.start = trace.start + (table.begin + static_cast<double>(first) * table.length) * trace.dt;
  f.offsets.assign(table.offsets.begin() + static_cast<std::ptrdiff_t>(first), table.offsets.end());
  const double between = average(table, first, f.mean), rounding = f.quantum * f.quantum / 12.0;
  // Periods that read alike to the last count share their rounding: averaging does not help.
  f.noise = std::sqrt(between > 0.5 * rounding ? between / static_cast<double>(f.periods) : rounding);
  if (between < kDithered * rounding) f.rounding = std::sqrt(rounding);
  f.drift = drift_of(table, first);
  const double origin = table.begin + static_cast<double>(first) * table.length;
  for (std::size_t tile = 0; tile < FoldedMotion::kTiles; ++tile)
    for (std::size_t b = 0; b < f.mean.size(); ++b) {
      f.tiled_x1.push_back(f.mean[b] + f.drift * static_cast<double>(tile));
      f.tiled_u.push_back(
          between_samples(trace.u, origin + (static_cast<double>(b) + 0.5) * f.dt / trace.dt));
    }
  return f;
}

}  // namespace gapscope::internal::signals
