#include "sliding_mode/impact_time.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/free_flight.h"
#include "sliding_mode/kink_fit.h"

namespace gapscope::internal {
namespace {

constexpr int kDegree = 1;
constexpr double kAlmostAsGood = 1.5;

struct Window {
  std::size_t first, after, end;  ///< end: one past the last sample
};

Window fit_window(const TransitionContext& context, const Event& impact, const Reversal& reversal) {
  const auto n = context.trace.size();
  const auto latency = static_cast<double>(impact.latency);
  const auto after = std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(0.8 * latency)));
  const auto flight = impact.start - reversal.last;
  const auto most = std::max(static_cast<std::size_t>(0.02 / context.trace.dt), 4 * after);
  const auto before = std::min(std::max<std::size_t>(std::min(flight / 2, most), 6), flight);
  return {impact.start - before, after, std::min(n, impact.start + after + 1)};
}

/// Contacts to try: their half period from two samples to four times the window after the impact, light and
/// heavy damping; the rigid impact is the limit of the fast ones.
std::vector<KinkShape> contact_shapes(std::size_t after) {
  constexpr int kRates = 9;
  std::vector<KinkShape> shapes{{1}};
  const double longest = 4.0 * static_cast<double>(after);
  for (int i = 0; i < kRates; ++i) {
    const double half_period = 2.0 * std::pow(longest / 2.0, i / (kRates - 1.0));
    for (const double damping : {0.05, 0.3}) shapes.push_back({0, kPi / half_period, damping});
  }
  return shapes;
}

}  // namespace

ImpactTime refine_impact(const TransitionContext& context, const Event& impact, const Reversal& reversal,
                         const FlightLaw& law) {
  ImpactTime result;
  const Window w = fit_window(context, impact, reversal);
  const std::size_t flight = impact.start - std::min(reversal.last, impact.start);
  result.core = impact.start - std::max<std::size_t>(2, flight / 10);
  FlightLaw::Fit before_impact;
  if (w.end < w.first + 9 || !law.fit_before(result.core, before_impact)) return result;
  std::vector<double> left;
  for (std::size_t i = w.first; i < w.end; ++i)
    left.push_back(context.trace.x1[i] - law.state(before_impact, static_cast<double>(i)).position);
  const KinkScan scan(left, w.first, kDegree);
  const auto start = static_cast<double>(impact.start);
  const double back =
      std::min(static_cast<double>(3 * w.after + 2), 0.5 * (start - static_cast<double>(w.first)));
  std::vector<KinkFit> fits;
  for (const KinkShape& shape : contact_shapes(w.after))
    fits.push_back(
        scan.best(shape, start - back, static_cast<double>(w.end) - 2.0, std::max(0.5, back / 20.0)));
  const KinkFit& best =
      *std::min_element(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.sse < b.sse; });
  // Noise alone leaves this much: below it all fits are equally good.
  const double sigma = context.facts.noise;
  const double resolution = sigma * sigma * static_cast<double>(scan.size());
  double low = best.time, high = best.time;
  for (const KinkFit& fit : fits) {
    if (fit.sse > kAlmostAsGood * std::max(best.sse, 0.25 * resolution)) continue;
    low = std::min(low, fit.time);
    high = std::max(high, fit.time);
  }
  // A kink far from where e left its floor is to be trusted less.
  const double half = std::max(0.5 * (high - low), 0.25 * std::abs(best.time - start));
  const double dt = context.trace.dt;
  const MotorState before = law.state(before_impact, best.time);
  result.found = true;
  result.time = best.time;
  result.half_width = half * dt;
  result.position = before.position + best.position;
  result.speed = before.speed + best.slope / dt;
  result.acceleration = before.acceleration;
  result.drive = law.drive(before_impact, best.time);
  return result;
}

}  // namespace gapscope::internal
