#include "sliding_mode/published/bend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/kink_fit.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kFewestOfBend = 8;
constexpr double kStandsOut = 4.0;  ///< squared error without the bend, over that with it

std::vector<double> samples_of(const BankErrors& run, std::size_t first, std::size_t end) {
  std::vector<double> e;
  for (std::size_t i = first; i < end; ++i) e.push_back(run.error(i, 0));
  return e;
}

/// First sample after the peak that noise and chatter cannot explain.
std::size_t clearly_fallen(const BankErrors& run, const Excursion& x) {
  std::size_t i = x.peak + 1;
  while (i < x.end && x.sign * run.error(i, 0) > x.height - 3.0 * run.floor[0]) ++i;
  return i;
}

/// A rigid impact, and elastic contacts from two samples to as long as `longest` samples.
std::vector<KinkShape> impact_shapes(double longest) {
  std::vector<KinkShape> shapes{{1}};
  for (double half_period = 2.0; half_period < longest; half_period *= 1.7)
    shapes.push_back({0, kPi / half_period, 0.1});
  return shapes;
}

}  // namespace

double bend_before_peak(const BankErrors& run, const Excursion& ramp, double since) {
  const double flight = static_cast<double>(ramp.peak) - since;
  const auto back = std::max(kFewestOfBend, static_cast<std::size_t>(std::max(0.25 * flight, 0.0)));
  const std::size_t first = ramp.peak - std::min(back, ramp.peak);
  const std::size_t end = std::min(run.samples(), clearly_fallen(run, ramp) + 1);
  if (end < first + kFewestOfBend) return static_cast<double>(ramp.peak);
  const KinkScan scan(samples_of(run, first, end), first, polynomial_columns(end - first, 2));
  KinkFit best;
  best.time = static_cast<double>(ramp.peak);
  best.sse = kInfinity;
  const double step = std::max(0.5, static_cast<double>(back) / 30.0);
  for (const KinkShape& shape : impact_shapes(0.8 * flight)) {
    const KinkFit fit = scan.best(shape, static_cast<double>(first + 3), static_cast<double>(end - 1), step);
    if (fit.sse < best.sse) best = fit;
  }
  const bool at_the_rim = best.time < static_cast<double>(first) + 0.15 * static_cast<double>(back);
  const bool stands_out = scan.smooth_sse() > kStandsOut * best.sse;
  return stands_out && !at_the_rim ? best.time : static_cast<double>(ramp.peak);
}

std::optional<double> bend_at_release(const BankErrors& run, const Excursion& ramp, std::size_t turn) {
  const auto flight = static_cast<double>(ramp.peak - turn);
  const auto back = static_cast<std::size_t>(0.6 * flight), ahead = static_cast<std::size_t>(0.3 * flight);
  if (turn < ramp.start + back || back + ahead < kFewestOfBend) return std::nullopt;
  const std::size_t first = turn - back, end = turn + ahead;
  const KinkScan scan(samples_of(run, first, end), first, polynomial_columns(end - first, 2));
  const KinkFit fit = scan.best({3}, static_cast<double>(first + 3), static_cast<double>(end - 4),
                                std::max(1.0, flight / 60.0));
  if (fit.amplitude * ramp.sign <= 0.0 || scan.smooth_sse() < kStandsOut * fit.sse) return std::nullopt;
  return fit.time;
}

}  // namespace gapscope::internal::sliding_mode
