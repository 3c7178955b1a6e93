#include "sliding_mode/impact_time.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/kink_fit.h"

namespace gapscope::internal {
namespace {

struct Window {
  std::size_t first, after, end;  ///< end: one past the last sample
};

Window fit_window(const TransitionContext& context, const Event& impact, const Reversal& reversal) {
  const auto n = context.trace.size();
  const auto latency = static_cast<double>(impact.peak - impact.start);
  const auto after = std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(0.8 * latency)));
  const auto flight = impact.start - reversal.last;
  const auto most = std::max(static_cast<std::size_t>(0.02 / context.trace.dt), 4 * after);
  const auto before = std::min(std::max<std::size_t>(std::min(flight / 2, most), 6), flight);
  return {impact.start - before, after, std::min(n, impact.start + after + 1)};
}

}  // namespace

ImpactTime refine_impact(const TransitionContext& context, const Event& impact, const Reversal& reversal) {
  ImpactTime result;
  const Window w = fit_window(context, impact, reversal);
  if (w.end < w.first + 9) return result;
  const KinkScan scan(context.trace.x1.subspan(w.first, w.end - w.first), w.first, 2);
  const auto start = static_cast<double>(impact.start);
  const double back =
      std::min(static_cast<double>(2 * w.after + 2), 0.5 * (start - static_cast<double>(w.first)));
  std::array<KinkFit, 3> fits;
  for (int p = 1; p <= 3; ++p)
    fits[static_cast<std::size_t>(p - 1)] =
        scan.best(p, start - back, static_cast<double>(w.end) - 2.0, std::max(0.5, back / 40.0));
  const KinkFit& best =
      *std::min_element(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.sse < b.sse; });
  // Quantisation alone leaves this much: below it all fits are equally good.
  const double sigma = context.facts.noise;
  const double resolution = 0.5 * sigma * sigma * static_cast<double>(scan.size());
  double low = best.time, high = best.time;
  for (const KinkFit& fit : fits) {
    if (fit.sse > 2.0 * std::max(best.sse, resolution)) continue;
    low = std::min(low, fit.time);
    high = std::max(high, fit.time);
  }
  const double dt = context.trace.dt;
  result = {true,          best.time,       0.5 * (high - low) * dt,
            best.position, best.slope / dt, best.curvature / (dt * dt)};
  return result;
}

}  // namespace gapscope::internal
