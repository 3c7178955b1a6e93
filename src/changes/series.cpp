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

/// How far a unit lies from the others, as a normal number.
double distance_of(const Readings& r, std::size_t unit) {
  double sum = 0.0, errors = 0.0, squares = 0.0;
  const auto others = static_cast<double>(r.size() - 1);
  for (std::size_t i = 0; i < r.size(); ++i)
    if (i != unit) sum += r.y[i], errors += r.s[i] * r.s[i];
  const double centre = sum / others;
  for (std::size_t i = 0; i < r.size(); ++i)
    if (i != unit) squares += (r.y[i] - centre) * (r.y[i] - centre);
  const double spread = std::max(squares / (others - 1.0), errors / others);
  const double own = std::max(r.s[unit] * r.s[unit] - errors / others, 0.0);
  const double t = (r.y[unit] - centre) / std::sqrt(spread * (1.0 + 1.0 / others) + own);
  return normal_of_student(t, others - 1.0);
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
