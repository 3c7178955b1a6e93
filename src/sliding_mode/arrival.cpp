#include "sliding_mode/arrival.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/release.h"
#include "sliding_mode/shared_law.h"
#include "sliding_mode/transition.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Of the way from the rest to the impact: the last of the arrival, looked at. What leaves earlier shows in
/// the longer ones.
constexpr double kArrivals[] = {0.06, 0.12, 0.25};
constexpr double kStay = 0.1;  ///< of the flight: a rest, no turn
/// Mean square that one law may leave, over the noise's or the flight's own. Where the load has left it is
/// 1.0 to 1.1 (3380020), where it has not from 10 on but for the last few counts (3380015, gap trapezoid).
constexpr double kFollows = 1.3;

/// How far the torque would have moved a free motor against the passage while it rested [rad].
double held_back(const MotorTrace& trace, const Reversal& r, double drive) {
  double speed = 0.0, way = 0.0, most = 0.0;
  for (std::size_t i = r.first; i < r.last; ++i) {
    const double gained = -r.direction * drive * trace.u[i] * trace.dt;
    way += (speed + 0.5 * gained) * trace.dt;
    speed += gained;
    most = std::max(most, way);
  }
  return most;
}

/// Where x1 was last so far from its rest, before it; 0: never.
std::size_t arriving(const MotorTrace& trace, const Reversal& r, double way) {
  std::size_t i = r.first;
  while (i > 0 && r.direction * (trace.x1[i] - r.position) < way) --i;
  return i;
}

}  // namespace

bool may_rest_alone(const TransitionContext& context, const Reversal& r, std::size_t begin,
                    std::size_t core) {
  const MotorTrace& trace = context.trace;
  const auto flight = static_cast<double>(core - std::min(core, r.last));
  if (begin < r.first || static_cast<double>(r.last - r.first) < kStay * flight) return false;
  if (core < begin + SharedLaw::kFewestRows) return false;
  const LawStretch after{begin, begin, core, r.direction};
  const SharedLaw alone(trace, {after});
  const double least = context.facts.least_way();
  if (held_back(trace, r, alone.drive()) > least) return false;
  for (const double share : kArrivals) {
    const std::size_t from = arriving(trace, r, std::max(share * r.rise, least));
    if (r.first < from + SharedLaw::kFewestRows) continue;
    const SharedLaw both(trace, {{from, from, r.first, -r.direction}, after});
    const double left = both.rms() / std::max(alone.rms(), context.facts.noise);
    if (left * left < kFollows) return true;
  }
  return false;
}

}  // namespace gapscope::internal::sliding_mode
