#include "changes/series.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "base/normal.h"
#include "changes/chance.h"

namespace gapscope::internal::changes {
namespace {

constexpr double kAlarm = 0.05;          ///< rate of false ones, all quantities together
constexpr double kMedianSquare = 0.455;  ///< of a standard normal number

/// What the reports that have a value say.
struct Readings {
  std::vector<int> report;
  std::vector<double> y, s;
  std::size_t size() const { return y.size(); }
};

Readings readings_of(const DriveQuantity& q) {
  Readings r;
  for (std::size_t i = 0; i < q.observed.size(); ++i) {
    const Observation& o = q.observed[i];
    if (!o.has_value() || !(o.ci95.high > o.ci95.low)) continue;
    r.report.push_back(static_cast<int>(i));
    r.y.push_back(o.value), r.s.push_back((o.ci95.high - o.ci95.low) / (2.0 * kNormal95));
  }
  return r;
}

/// By how much neighbours scatter beyond their errors; a step or a slow trend is in few of the differences.
double beyond_errors(const Readings& r) {
  std::vector<double> squares;
  for (std::size_t i = 1; i < r.size(); ++i)
    squares.push_back(std::pow(r.y[i] - r.y[i - 1], 2) / (r.s[i] * r.s[i] + r.s[i - 1] * r.s[i - 1]));
  return std::sqrt(std::max(1.0, median(std::move(squares)) / kMedianSquare));
}

struct WeightedMean {
  double value = 0.0, std = kInfinity;
};

WeightedMean mean_over(const Readings& r, std::size_t from, std::size_t to) {
  double weights = 0.0, sum = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    const double w = 1.0 / (r.s[i] * r.s[i]);
    weights += w, sum += w * r.y[i];
  }
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

/// Slope from report to report, weighted.
void take_trend(const Readings& r, double widening, QuantityCourse& c) {
  double w = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double weight = 1.0 / (r.s[i] * r.s[i]), at = r.report[i];
    w += weight, x += weight * at, xx += weight * at * at, y += weight * r.y[i], xy += weight * at * r.y[i];
  }
  const double spread = xx - x * x / w;
  c.slope = (xy - x * y / w) / spread;
  c.slope_ci95 = normal_interval(c.slope, widening / std::sqrt(spread));
}

QuantityCourse course_of(const DriveQuantity& q, const Readings& r, double quantile) {
  QuantityCourse c;
  c.key = q.key, c.from = q.from, c.unit = q.unit, c.level = q.level;
  const double widening = beyond_errors(r);
  take_trend(r, widening, c);
  double farthest = 0.0;
  for (std::size_t k = 1; k < r.size(); ++k) {
    const WeightedMean a = mean_over(r, 0, k), b = mean_over(r, k, r.size());
    const double std = widening * std::hypot(a.std, b.std), z = std::abs(b.value - a.value) / std;
    if (!(z > farthest)) continue;
    farthest = z;
    c.before = a.value, c.after = b.value;
    c.step_ci95 = normal_interval(b.value - a.value, std);
    if (z > quantile) c.since = r.report[k];
  }
  if (!(farthest > quantile)) c.since = -1;
  return c;
}

struct Followed {
  const DriveQuantity* quantity;
  Readings readings;
};

std::vector<Followed> followed(const DriveChanges& all) {
  std::vector<Followed> some;
  for (const DriveQuantity& q : all.quantities)
    if (Readings r = readings_of(q); std::ssize(r.y) >= kFewestInOrder) some.push_back({&q, std::move(r)});
  return some;
}

constexpr std::size_t kNoUnit = ~std::size_t{0};

/// Twice the log likelihood, but for a constant, of units that scatter about one mean with this variance
/// beside their errors, one of them wherever it is.
double twice_log_likelihood(const Readings& r, double variance, std::size_t apart) {
  double weights = 0.0, sum = 0.0, logs = 0.0, squares = 0.0;
  const auto weight = [&](std::size_t i) { return 1.0 / (variance + r.s[i] * r.s[i]); };
  for (std::size_t i = 0; i < r.size(); ++i) {
    logs += std::log(weight(i));
    if (i != apart) weights += weight(i), sum += weight(i) * r.y[i];
  }
  for (std::size_t i = 0; i < r.size(); ++i)
    if (i != apart) squares += weight(i) * std::pow(r.y[i] - sum / weights, 2);
  return logs - squares;
}

/// The same with the variance at which it is largest, of those from none up to the square of the range.
double most_likely(const Readings& r, std::size_t apart) {
  constexpr double kFinest = 1e-3;  ///< of the range, as a standard deviation; below it is none
  constexpr int kVariances =
      60;  ///< of the logarithm: 12 % each, on which twice the likelihood varies by 0.03
  const auto [least, most] = std::ranges::minmax(r.y);
  double best = twice_log_likelihood(r, 0.0, apart);
  for (int k = 0; k <= kVariances; ++k) {
    const double std = (most - least) * std::pow(kFinest, static_cast<double>(k) / kVariances);
    best = std::max(best, twice_log_likelihood(r, std * std, apart));
  }
  return best;
}

/// How far a unit lies from the others, as a normal number: by how much likelier all are where it has a mean
/// of its own. Without errors that is Student's t of the unit against the others exactly: n log(1 + t²/ν),
/// with ν = n − 2 (see normal_of_student); with errors that explain all scatter the square of a normal
/// number, which this makes a little smaller.
double distance_of(const Readings& r, std::size_t unit) {
  const auto n = static_cast<double>(r.size());
  const double gain = std::max(0.0, most_likely(r, unit) - most_likely(r, kNoUnit));
  const double freedom = n - 2.0;
  const double t = std::sqrt(freedom * std::expm1(gain / n));
  double centre = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i)
    if (i != unit) centre += r.y[i] / (n - 1.0);
  return std::copysign(normal_of_student(t, freedom), r.y[unit] - centre);
}

}  // namespace

std::vector<QuantityCourse> courses(const DriveChanges& all) {
  std::vector<QuantityCourse> found;
  const std::vector<Followed> some = followed(all);
  double places = 0.0;
  for (const Followed& f : some) places += static_cast<double>(f.readings.size() - 1);
  const double quantile = two_sided_quantile(kAlarm / std::max(places, 1.0));
  for (const Followed& f : some) found.push_back(course_of(*f.quantity, f.readings, quantile));
  return found;
}

std::vector<OddUnit> odd_units(const DriveChanges& all) {
  std::vector<OddUnit> odd;
  const std::vector<Followed> some = followed(all);
  double places = 0.0;
  for (const Followed& f : some) places += static_cast<double>(f.readings.size());
  const double quantile = two_sided_quantile(kAlarm / std::max(places, 1.0));
  for (const Followed& f : some)
    for (std::size_t i = 0; i < f.readings.size(); ++i)
      if (const double z = distance_of(f.readings, i); std::abs(z) > quantile)
        odd.push_back({f.readings.report[i], f.quantity->key, f.quantity->from, f.quantity->level, z});
  std::ranges::stable_sort(odd, std::greater{}, [](const OddUnit& o) { return std::abs(o.distance); });
  return odd;
}

}  // namespace gapscope::internal::changes
