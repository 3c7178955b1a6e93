#include "sliding_mode/arrival.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/shared_law.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Of the way from the rest to the impact: the last of the arrival, looked at. What leaves earlier shows in
/// the longer ones.
constexpr double kArrivals[] = {0.06, 0.12, 0.25};
constexpr double kStay = 0.1;  ///< of the flight: a rest, no turn
/// Mean square that one law may leave of the arrival, over the noise's. Where the load has left it is 1.1
/// (3380020 gap trapezoid) and 0.9 (3387027), where it has not 1.3 to 90 over the last few counts (3380009,
/// 3380044, 3380015), and 2 to 60 beyond.
constexpr double kFollows = 1.3;

/// How far the torque would have moved a motor without friction against the passage while it rested [rad].
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

/// What the law leaves over [rad²].
double squares(const SharedLaw& law, std::span<const LawStretch> stretches) {
  auto freedom = -static_cast<double>(SharedLaw::kShared);
  for (const LawStretch& s : stretches)
    freedom += static_cast<double>(s.last - s.first + 1) - SharedLaw::kLocal;
  return law.rms() * law.rms() * freedom;
}

/// A rest, not a turn, from which the flight begins.
bool rests(const RestBeforeFlight& p) {
  const auto flight = static_cast<double>(p.core - std::min(p.core, p.rest.last));
  return p.begin >= p.rest.first && static_cast<double>(p.rest.last - p.rest.first) >= kStay * flight &&
         p.core >= p.begin + SharedLaw::kFewestRows;
}

}  // namespace

bool may_rest_alone(const MotorTrace& trace, const signals::SignalFacts& facts,
                    std::span<const RestBeforeFlight> passages) {
  std::vector<RestBeforeFlight> at_rest;
  std::ranges::copy_if(passages, std::back_inserter(at_rest), rests);
  if (2 * at_rest.size() < passages.size() || at_rest.empty()) return false;
  std::vector<LawStretch> flights;
  for (const auto& p : at_rest) flights.push_back({p.begin, p.begin, p.core, p.rest.direction});
  const SharedLaw alone(trace, flights, SharedLaw::Friction::kPassive);
  std::vector<double> held;
  for (const auto& p : at_rest) held.push_back(held_back(trace, p.rest, alone.drive()));
  const double least = facts.least_way();
  if (median(held) > least) return false;
  for (const double share : kArrivals) {
    std::vector<LawStretch> both = flights;
    double rows = 0.0;
    for (const auto& p : at_rest) {
      const std::size_t from = arriving(trace, p.rest, std::max(share * p.rest.rise, least));
      if (p.rest.first < from + SharedLaw::kFewestRows) continue;
      both.push_back({from, from, p.rest.first, -p.rest.direction});
      rows += static_cast<double>(p.rest.first - from) - 1.0;
    }
    if (rows == 0.0) continue;
    const SharedLaw law(trace, both, SharedLaw::Friction::kPassive);
    const double left = (squares(law, both) - squares(alone, flights)) / rows;
    const double noise = std::max(alone.rms(), facts.noise);
    if (left < kFollows * noise * noise) return true;
  }
  return false;
}

}  // namespace gapscope::internal::sliding_mode
