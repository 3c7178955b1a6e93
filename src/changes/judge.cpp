#include "changes/judge.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "changes/chance.h"

namespace gapscope::internal::changes {
namespace {

/// How far a value may be off on either side, as wide as so many standard errors.
struct Reach {
  double below, above;
};

Reach reach_of(const Observation& o, double quantile) {
  const double times = quantile / kNormal95;
  return {times * (o.value - o.ci95.low), times * (o.ci95.high - o.value)};
}

bool has_interval(const Observation& o) { return std::isfinite(o.ci95.low) && std::isfinite(o.ci95.high); }

/// Where the quantity may lie; a bound says nothing of its other side, but what is at most something is no
/// less than nothing.
Interval room_of(const Observation& o, double quantile) {
  if (o.has_value()) {
    const Reach r = reach_of(o, quantile);
    return {o.value - r.below, o.value + r.above};
  }
  return {std::isfinite(o.at_least) ? o.at_least : 0.0, std::isfinite(o.at_most) ? o.at_most : kInfinity};
}

Interval interval_of(const Observation& first, const Observation& now, double quantile) {
  if (first.has_value() && now.has_value()) {
    const Reach a = reach_of(first, quantile), b = reach_of(now, quantile);
    const double difference = now.value - first.value;
    return {difference - std::hypot(b.below, a.above), difference + std::hypot(b.above, a.below)};
  }
  const Interval a = room_of(first, quantile), b = room_of(now, quantile);
  return {b.low - a.high, b.high - a.low};
}

bool without(const Interval& i, double zero_reach) { return i.low > zero_reach || i.high < -zero_reach; }

/// The quantile at which the interval reaches zero; 0: it does at any.
double quantile_at_zero(const Observation& first, const Observation& now) {
  if (!without(interval_of(first, now, 1e-9), 0.0)) return 0.0;
  double low = 0.0, high = 1.0;
  while (high < 1e6 && without(interval_of(first, now, high), 0.0)) high *= 2.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (without(interval_of(first, now, middle), 0.0) ? low : high) = middle;
  }
  return low;
}

double size_of(const Observation& o) { return o.has_value() ? std::abs(o.value) : 0.0; }

Interval finite(Interval i) {
  return {std::isfinite(i.low) ? i.low : kNaN, std::isfinite(i.high) ? i.high : kNaN};
}

void decide(const DriveQuantity& q, std::size_t i, double quantile, std::optional<double> tolerance,
            Change& c) {
  const Observation &first = q.observed.front(), &now = q.observed[i];
  const Interval together = interval_of(first, now, quantile);
  c.together = finite(together);
  c.margin = q.unit == "rad" && tolerance ? *tolerance : kMatters * std::max(size_of(first), size_of(now));
  c.reason = ChangeReason::kTooWide;
  if (without(together, c.by_recordings)) {
    c.verdict = ChangeVerdict::kChanged, c.reason = ChangeReason::kBeyondError;
  } else if (without(together, 0.0)) {
    c.reason = ChangeReason::kTheRecordings;
  } else if (together.low >= -c.margin && together.high <= c.margin && c.margin > 0.0) {
    c.verdict = ChangeVerdict::kSame, c.reason = ChangeReason::kWithin;
  }
}

bool comparable(const Change& c) {
  return c.reason != ChangeReason::kUntold && c.reason != ChangeReason::kNoInterval &&
         c.reason != ChangeReason::kTheModel;
}

}  // namespace

Change change_between(const Observation& first, const Observation& now) {
  Change c;
  if (first.has_value() && now.has_value()) c.difference = now.value - first.value;
  for (const Observation* o : {&first, &now}) {
    if (!o->has_value() && !o->has_bound()) return c;
    if (o->has_value() && !has_interval(*o)) c.reason = ChangeReason::kNoInterval;
  }
  if (c.reason == ChangeReason::kNoInterval) return c;
  c.ci95 = finite(interval_of(first, now, kNormal95));
  c.p = normal_beyond(quantile_at_zero(first, now));
  c.reason = ChangeReason::kTooWide;
  return c;
}

void give_verdicts(DriveChanges& all, std::optional<double> tolerance) {
  all.compared = 0;
  for (const DriveQuantity& q : all.quantities)
    all.compared += static_cast<int>(std::count_if(q.changes.begin(), q.changes.end(), comparable));
  all.quantile = two_sided_quantile(kErrorRate / std::max(all.compared, 1));
  for (DriveQuantity& q : all.quantities)
    for (std::size_t i = 0; i < q.changes.size(); ++i)
      if (comparable(q.changes[i])) decide(q, i + 1, all.quantile, tolerance, q.changes[i]);
}

}  // namespace gapscope::internal::changes
