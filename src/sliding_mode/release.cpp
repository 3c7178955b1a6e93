#include "sliding_mode/release.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/impact_time.h"
#include "sliding_mode/kink_fit.h"
#include "sliding_mode/transition.h"

namespace gapscope::internal {
namespace {

constexpr std::size_t kFewestSamples = 8;

/// First sample after the reversal at which x1 has covered this share of the rise.
std::size_t sample_at_rise(const TransitionContext& context, const Reversal& r, double share,
                           std::size_t end) {
  std::size_t i = r.last;
  while (i < end && r.direction * (context.trace.x1[i] - r.position) < share * r.rise) ++i;
  return i;
}

/// A parabola from the reversal to t1 is no rest: the motor was already on its way, freely.
bool leaves_at_once(std::span<const double> rest, std::size_t first, double rise) {
  if (rest.size() < 6) return false;
  const KinkFit end = KinkScan(rest, first, 2).best({1}, static_cast<double>(first + rest.size()), 0.0);
  const auto n = static_cast<double>(rest.size());
  const double bent = 0.5 * std::abs(end.curvature) * n * n;
  const double straight = std::abs(end.slope) * n - 2.0 * bent;  // slope at its beginning
  const double moved = std::abs(end.position - rest.front());
  return moved > 0.008 * rise && bent > 0.4 * (bent + std::max(straight, 0.0));
}

Release find_dwell(const TransitionContext& context, const Reversal& r, const ImpactTime& impact) {
  Release release;
  const auto& trace = context.trace;
  const auto t2 = static_cast<std::size_t>(impact.time);
  const std::size_t end = sample_at_rise(context, r, 0.3, t2) + 1;
  if (end < r.first + kFewestSamples) return release;
  const auto window = trace.x1.subspan(r.first, end - r.first);
  const KinkScan line(window, r.first, 1);
  const double cubic = KinkScan(window, r.first, 3).smooth_sse();
  const double step = std::max(1.0, static_cast<double>(window.size()) / 60.0);
  const double from = static_cast<double>(r.first), to = static_cast<double>(end - 4);
  KinkFit fit = line.best({3}, from, to, step);
  if (const KinkFit square = line.best({2}, from, to, step); square.sse < fit.sse) fit = square;
  const double flight = static_cast<double>(t2 - r.first);
  const double rest = fit.time - from;
  const double slope = std::abs(fit.slope) / trace.dt;
  if (!(fit.sse < cubic) || rest < std::max(2.0, 0.12 * flight) || slope > 0.08 * std::abs(impact.speed))
    return release;
  const auto rest_end = static_cast<std::size_t>(fit.time) + 1 - r.first;
  if (leaves_at_once(window.subspan(0, std::min(rest_end, window.size())), r.first, r.rise)) return release;
  const double unwound = std::abs(fit.position - r.position);
  release.found = release.dwell = true;
  release.time = fit.time;
  release.position = fit.position;
  release.half_width = 0.25 * unwound + 0.5 * slope * rest * trace.dt;
  return release;
}

/// Travel of a passive load from speed w and deceleration a within the time D: its least and its most.
std::pair<double, double> load_travel(double w, double a, double D) {
  if (w <= 0.0) return {0.0, 0.0};
  if (a <= 0.0) return {0.0, w * D};
  const double least = w / a < D ? 0.5 * w * w / a : w * D - 0.5 * a * D * D;
  return {least, w * w / a * -std::expm1(-a * D / w)};
}

Release separation_in(const TransitionContext& context, const Reversal& r, const ImpactTime& impact,
                      double share) {
  Release release;
  const auto& trace = context.trace;
  const auto flight = static_cast<std::size_t>(impact.time) - r.last;
  const auto back = std::min(static_cast<std::size_t>(share * static_cast<double>(flight)), r.last);
  const std::size_t begin = r.last - back;
  const std::size_t end = sample_at_rise(context, r, 0.3, static_cast<std::size_t>(impact.time)) + 1;
  if (end < begin + kFewestSamples) return release;
  const KinkScan scan(trace.x1.subspan(begin, end - begin), begin, 2);
  const double step = std::max(1.0, static_cast<double>(scan.size()) / 60.0);
  const KinkFit fit = scan.best({3}, static_cast<double>(begin + 3), static_cast<double>(end - 4), step);
  if (fit.sse * 1.4 > scan.smooth_sse()) return release;
  const double w = -r.direction * fit.slope / trace.dt;
  const double a = r.direction * fit.curvature / (trace.dt * trace.dt);
  const auto [least, most] = load_travel(w, a, (impact.time - fit.time) * trace.dt);
  release.found = true;
  if (w <= 0.0) {  // past the reversal the motor has already left a load that can only be pushed: at rest
    release.time = static_cast<double>(r.last);
    release.position = r.position;
    release.half_width = 0.25 * std::abs(fit.position - r.position);
    return release;
  }
  release.time = fit.time;
  release.position = fit.position;
  release.load_travel = 0.5 * (least + most);
  release.travel_half_width = release.half_width = 0.5 * (most - least);
  return release;
}

}  // namespace

Release find_release(const TransitionContext& context, const Reversal& r, const ImpactTime& impact) {
  if (const Release dwell = find_dwell(context, r, impact); dwell.found) return dwell;
  for (const double share : {0.6, 1.0, 1.6})
    if (const Release s = separation_in(context, r, impact, share); s.found) return s;
  return {};
}

}  // namespace gapscope::internal
