#include "sliding_mode/drawn_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// How long before t1 e_x is looked at, as a share of the passage.
constexpr double kBeforeRelease = 0.5;
/// A bound slides where |e_x| is within twice its floor for this share of the samples looked at, as
/// smallest_sliding() has it.
constexpr double kSliding = 0.8;

/// Which samples are looked at.
std::vector<bool> looked_at(const MotorTrace& trace, std::span<const GapEvent> events) {
  std::vector<bool> chosen(trace.size());
  bool any = false;
  const auto sample = [&](double time) {
    const double i = std::round((time - trace.start) / trace.dt);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(trace.size() - 1)));
  };
  for (const GapEvent& e : events) {
    if (!e.accepted || e.file != trace.file || !(e.t2 > e.t1)) continue;
    any = true;
    for (std::size_t i = sample(e.t1 - kBeforeRelease * (e.t2 - e.t1)); i < sample(e.t1); ++i)
      chosen[i] = true;
  }
  if (!any) std::fill(chosen.begin(), chosen.end(), true);
  return chosen;
}

double smallest_that_slides(const MotorTrace& trace, const signals::SignalFacts& facts,
                            const std::vector<bool>& chosen) {
  const std::vector<double> bounds = bound_grid(facts, trace.dt);
  const std::vector<double> floors = chatter_floors(facts, trace.dt, bounds, Discretisation::kForwardEuler);
  for (std::size_t j = 0; j < bounds.size(); ++j) {
    SuperTwistingDifferentiator differentiator(bounds[j]);
    double seen = 0.0, quiet = 0.0;
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const double error = differentiator.step(trace.x1[i], trace.dt).error;
      if (chosen[i]) ++seen, quiet += std::abs(error) < 2.0 * floors[j] ? 1.0 : 0.0;
    }
    if (quiet >= kSliding * seen) return bounds[j];
  }
  return bounds.back();
}

}  // namespace

double drawn_bound(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                   std::span<const GapEvent> events) {
  std::vector<double> bounds;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    if (facts[i].defect.empty())
      bounds.push_back(smallest_that_slides(recordings[i], facts[i], looked_at(recordings[i], events)));
  return median(std::move(bounds));
}

}  // namespace gapscope::internal::sliding_mode
