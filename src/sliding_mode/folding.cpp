#include "sliding_mode/folding.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal {
namespace {

constexpr double kRepeats = 1e-3;      ///< share of the variance by which one period may differ from the next
constexpr std::size_t kCoarse = 3000;  ///< samples of the search for the period
constexpr std::size_t kFewestPeriods = 3;

double at(std::span<const double> u, double i) {
  const auto k = static_cast<std::size_t>(i);
  if (k + 1 >= u.size()) return u.back();
  const double share = i - static_cast<double>(k);
  return (1.0 - share) * u[k] + share * u[k + 1];
}

double variance(std::span<const double> u) {
  const double m = mean(u);
  double sum = 0.0;
  for (const double v : u) sum += (v - m) * (v - m);
  return sum / static_cast<double>(u.size());
}

/// Mean squared change over a lag [samples], over twice the variance.
double change(std::span<const double> u, double lag, std::size_t stride, double var) {
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; static_cast<double>(i) + lag < static_cast<double>(u.size() - 1);
       i += stride, ++n) {
    const double d = at(u, static_cast<double>(i) + lag) - u[i];
    sum += d * d;
  }
  return n > 0 ? 0.5 * sum / (static_cast<double>(n) * var) : kInfinity;
}

/// Best lag in [low, high] by a grid that closes in.
double refine(std::span<const double> u, double low, double high, std::size_t stride, double var) {
  double best = 0.5 * (low + high), width = 0.5 * (high - low);
  for (; width > 1e-4; width *= 0.5) {
    const double centre = best;
    double least = change(u, centre, stride, var);
    for (const double lag : {centre - 0.5 * width, centre + 0.5 * width})
      if (const double c = change(u, lag, stride, var); c < least) least = c, best = lag;
  }
  return best;
}

/// First lag at which the input repeats itself, within a few samples; 0 if none.
double rough_period(std::span<const double> u, double most, double var) {
  const std::size_t stride = std::max<std::size_t>(1, u.size() / kCoarse);
  const double limit = 0.05;
  bool away = false;
  double best = 0.0, least = limit;
  for (double lag = 1.0; lag < most; lag += static_cast<double>(stride)) {
    const double c = change(u, lag, stride, var);
    if (c > 0.3) away = true;
    if (!away) continue;
    if (c < least) least = c, best = lag;
    if (best > 0.0 && c > 0.3) break;  // past the first return
  }
  return best;
}

struct Bins {
  std::vector<double> sum, square;
  std::vector<std::size_t> count;
};

}  // namespace

MotorTrace FoldedMotion::trace(const std::string& file) const {
  return {file, start, dt, tiled_u, tiled_x1, 0.0};
}

double input_period(const MotorTrace& trace, double fewest) {
  const std::span<const double> u = trace.u;
  if (u.size() < 200) return 0.0;
  const double var = variance(u);
  if (!(var > 0.0)) return 0.0;
  const double n = static_cast<double>(u.size());
  const double rough = rough_period(u, n / fewest, var);
  if (rough <= 0.0) return 0.0;
  const double stride = std::max(1.0, n / static_cast<double>(kCoarse));
  const double near = refine(u, rough - 1.5 * stride, rough + 1.5 * stride, 1, var);
  const double repeats =
      std::floor((n - 2.0) / near) - 1.0;  // many periods apart: the same error counts less
  const double lag = refine(u, repeats * near - 2.0, repeats * near + 2.0, 1, var);
  if (change(u, lag / repeats, 1, var) > kRepeats) return 0.0;
  return lag / repeats * trace.dt;
}

FoldedMotion fold(const MotorTrace& trace) {
  FoldedMotion f;
  const double period = input_period(trace, static_cast<double>(kFewestPeriods + 1));
  if (period <= 0.0) return f;
  const double P = period / trace.dt;  // [samples]
  const auto whole = static_cast<std::size_t>((static_cast<double>(trace.size()) - 1.0) / P);
  const auto bins = static_cast<std::size_t>(std::lround(P));
  const std::size_t n = trace.size();
  std::vector<std::vector<double>> rows(whole, std::vector<double>(bins, kNaN));
  const double begin = static_cast<double>(n - 1) - static_cast<double>(whole) * P;
  const auto reach = std::max<std::size_t>(2, bins / 400);
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = (static_cast<double>(i) - begin) / P;
    if (phase < 0.0) continue;
    const auto row = static_cast<std::size_t>(phase);
    if (row >= whole) continue;
    const double place = (phase - static_cast<double>(row)) * static_cast<double>(bins);
    const auto bin = std::min(static_cast<std::size_t>(place), bins - 1);
    const std::size_t left = i - std::min(i, reach), right = std::min(i + reach, n - 1);
    const double slope = (trace.x1[right] - trace.x1[left]) / static_cast<double>(right - left);
    rows[row][bin] =
        trace.x1[i] + slope * (static_cast<double>(bin) + 0.5 - place) * P / static_cast<double>(bins);
  }
  // An empty bin (the grid is a little finer than the samples) takes its neighbours' mean.
  for (auto& row : rows)
    for (std::size_t b = 0; b < bins; ++b)
      if (std::isnan(row[b])) {
        const double left = b > 0 ? row[b - 1] : kNaN, right = b + 1 < bins ? row[b + 1] : kNaN;
        row[b] = std::isnan(left) ? right : std::isnan(right) ? left : 0.5 * (left + right);
      }
  std::vector<double> offsets;
  for (auto& row : rows) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const double v : row)
      if (!std::isnan(v)) sum += v, ++count;
    offsets.push_back(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
    for (double& v : row) v = std::isnan(v) ? 0.0 : v - offsets.back();
  }
  // The last periods agree best; earlier ones are taken while they do.
  const auto spread = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bins; ++i) sum += (rows[a][i] - rows[b][i]) * (rows[a][i] - rows[b][i]);
    return std::sqrt(0.5 * sum / static_cast<double>(bins));
  };
  const double settled = spread(whole - 1, whole - 2);
  std::size_t first = whole - 2;
  while (first > 0 && spread(first - 1, whole - 1) < 2.0 * std::max(settled, trace.quantum / 3.0)) --first;
  f.periods = whole - first;
  if (f.periods < kFewestPeriods) {
    f.periods = 0;
    return f;
  }
  f.period = period;
  f.dt = period / static_cast<double>(bins);
  f.start = (begin + static_cast<double>(first) * P) * trace.dt;
  f.offsets.assign(offsets.begin() + static_cast<std::ptrdiff_t>(first), offsets.end());
  // What the motion gains from one period to the next is no part of it: the mean must end where it begins.
  const double drift = (offsets.back() - offsets[first]) / static_cast<double>(f.periods - 1);
  for (std::size_t r = first; r < whole; ++r)
    for (std::size_t b = 0; b < bins; ++b)
      rows[r][b] -= drift * ((static_cast<double>(b) + 0.5) / static_cast<double>(bins) - 0.5);
  f.mean.assign(bins, 0.0);
  double scatter = 0.0;
  const auto k = static_cast<double>(f.periods);
  for (std::size_t b = 0; b < bins; ++b) {
    double sum = 0.0, square = 0.0;
    for (std::size_t r = first; r < whole; ++r) sum += rows[r][b], square += rows[r][b] * rows[r][b];
    f.mean[b] = sum / k;
    scatter += (square - sum * sum / k) / (k - 1.0);
  }
  const double quantum = trace.quantum > 0.0 ? trace.quantum : seen_quantum(trace.x1);
  const double between = scatter / static_cast<double>(bins), rounding = quantum * quantum / 12.0;
  // Periods that read alike to the last count share their rounding: averaging does not help.
  f.noise = std::sqrt(between > 0.5 * rounding ? between / k : rounding);
  for (std::size_t tile = 0; tile < FoldedMotion::kTiles; ++tile)
    for (std::size_t b = 0; b < bins; ++b) {
      f.tiled_x1.push_back(f.mean[b]);
      f.tiled_u.push_back(
          at(trace.u, (f.start / trace.dt) + (static_cast<double>(b) + 0.5) * P / static_cast<double>(bins)));
    }
  return f;
}

}  // namespace gapscope::internal
