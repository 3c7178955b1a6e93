#include "sliding_mode/passage/arrival.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/motion_law.h"
#include "sliding_mode/free_body.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Of the way from the rest to the impact: the last of the arrival, looked at. The shortest that has samples
/// enough tells whether the load is still there at the rest, the longer ones whether it has left before.
constexpr double kArrivals[] = {0.015, 0.03, 0.06, 0.12, 0.25};
/// Of that way: the shortest arrival in which a lone motor shows; any law follows less.
constexpr double kTellsAlone = 0.06;
/// Of the flight: how long its own friction holds a motor that rests by it. When it parted rests from turns
/// as well, of four gap sine wide rubs, 5160033, 5160072 and 5110017 (44, 4 and 23 % too small) are refused
/// by it, half and double, and 5160032 (1.3 %) is told by it and double, not by half.
constexpr double kStay = 0.1;
/// Mean square that one law may leave of the arrival, over the noise's. Where the load has left it is 1.1
/// (3380020 gap trapezoid) and 0.9 (3387027), where it has not 1.3 to 90 over the last few counts (3380009,
/// 3380044, 3380015), and 2 to 60 beyond.
constexpr double kFollows = 1.3;
/// Standard deviations of the mean square that roundings may leave, of a rest each: they are uniform, so that
/// of one is 2/√5 of its mean, and at most twice the mean above it. 3380020 and 3387027 gap trapezoid, which
/// do rest alone, leave 0.6 to 0.8 of the mean; arrivals at a load that are told by it 2 to 30 (eight of
/// 4100001 600 gap sine). Half tells nothing more of these; double loses 4100017 and 4100220, which leave 2.0
/// and 2.1 of 13 rests.
constexpr double kRoundingSpread = 3.0;

/// How far the torque would have moved a motor of that law against the passage while it rested [rad]. Within
/// its own dry friction [rad/s²] it stays where it is, with a load or without.
double held_back(const MotorTrace& trace, const Reversal& r, double drive, double dry) {
  double speed = 0.0, way = 0.0;
  for (std::size_t i = r.first; i < r.last; ++i) {
    const double gained = (-r.direction * drive * trace.u[i] - dry) * trace.dt;
    way += std::max(speed + 0.5 * gained, 0.0) * trace.dt;
    speed = std::max(speed + gained, 0.0);
  }
  return way;
}

/// Where x1 was last so far from its rest, before it, or turned round on its way there; 0: never.
/// @param least  way back that shows a turn [rad]
std::size_t arriving(const MotorTrace& trace, const Reversal& r, double way, double least) {
  std::size_t i = r.first, farthest = i;
  const auto off = [&](std::size_t k) { return std::abs(trace.x1[k] - r.position); };
  while (i > 0 && off(i) < way) {
    if (off(i) > off(farthest)) farthest = i;
    if (off(i) < off(farthest) - least) return farthest;
    --i;
  }
  return i;
}

/// From the last extreme sample to the end of the flight.
double flight_length(const RestBeforeFlight& p) {
  return static_cast<double>(p.core - std::min(p.core, p.rest.last));
}

signals::LawStretch flight_stretch(const RestBeforeFlight& p) {
  return {p.begin, p.core, static_cast<double>(p.begin), p.rest.direction};
}

/// Its own dry friction, by the law of the flight, can hold the motor as long as that near where it turns:
/// the torque is within it. (The extreme samples alone are anywhere in such a rest, by noise.)
/// @param way  that is surely none of noise and counting [rad]
bool rubs_to_rest(const MotorTrace& trace, const RestBeforeFlight& p, double way) {
  const signals::MotionLaw law(trace, {flight_stretch(p)}, signals::MotionLaw::Friction::kPassive);
  const auto near = [&](std::size_t i) { return std::abs(trace.x1[i] - p.rest.position) <= way; };
  const auto held = [&](std::size_t i) { return std::abs(law.drive() * trace.u[i]) <= law.dry(); };
  std::size_t last = p.begin;
  while (last > p.rest.first && !(near(last) && held(last))) --last;
  std::size_t first = last;
  while (first > 0 && near(first) && held(first)) --first;
  while (last < p.core && near(last) && held(last)) ++last;
  return law.dry() > 0.0 && static_cast<double>(last - first) >= kStay * flight_length(p);
}

/// The arrivals at the rests of all passages, from one distance on, where they have enough samples.
struct Arrivals {
  std::vector<signals::LawStretch> stretches;
  std::vector<FreeStretch> whole;  ///< from there through the rest to the end of the flight; else the flight
  double rows = 0.0, resting = 0.0;
  double way = 0.0, rise = 0.0;  ///< sums of what they are long, which a turn cuts, and of the way back [rad]
};

Arrivals arrivals(const MotorTrace& trace, std::span<const RestBeforeFlight> passages, double share,
                  double least) {
  Arrivals a;
  for (const auto& p : passages) {
    const std::size_t from = arriving(trace, p.rest, std::max(share * p.rest.rise, least), least);
    if (p.rest.first < from + signals::MotionLaw::kFewestRows) {
      a.whole.push_back({p.begin, p.core});
      continue;
    }
    a.stretches.push_back(
        {from, p.rest.first, static_cast<double>(from), trace.x1[from] < p.rest.position ? 1 : -1});
    a.whole.push_back({from, p.core});
    a.rows += static_cast<double>(p.rest.first - from) - 1.0;
    a.way += std::abs(trace.x1[from] - p.rest.position);
    a.rise += p.rest.rise;
    a.resting += static_cast<double>(p.begin) - static_cast<double>(p.rest.first);
  }
  return a;
}

/// What one law of flights and arrivals leaves of the arrivals, each from a place and at a speed of its own:
/// root mean square [rad].
double left_by_one_law(const MotorTrace& trace, const signals::MotionLaw& alone,
                       std::span<const signals::LawStretch> flights, const Arrivals& a) {
  std::vector<signals::LawStretch> both(flights.begin(), flights.end());
  both.insert(both.end(), a.stretches.begin(), a.stretches.end());
  const signals::MotionLaw law(trace, both, signals::MotionLaw::Friction::kPassive);
  return std::sqrt(std::max(law.squares() - alone.squares(), 0.0) / a.rows);
}

/// Whether a lone motor can do all that: arrive, rest at one place without a speed, and leave from there.
/// Each rest has one rounding, however long it is.
bool can_be_alone(const MotorTrace& trace, const signals::SignalFacts& facts, const signals::MotionLaw& alone,
                  const Arrivals& a) {
  const FreeMotion motion{
      trace.dt, {trace.u.begin(), trace.u.end()}, {trace.x1.begin(), trace.x1.end()}, a.whole};
  const FreeBody motor{alone.drive(), alone.viscous(), alone.dry()};
  const double all = follow(motion, motor, FreeNumbers::kDriveAndFriction).squares;
  if (!std::isfinite(all)) return true;
  const double left = (all - alone.squares()) / (a.rows + a.resting);
  const double noise = std::max(alone.rms(), facts.quantum / std::sqrt(12.0));
  const double spread = 2.0 / std::sqrt(5.0 * static_cast<double>(a.whole.size()));
  return left < (1.0 + std::min(kRoundingSpread * spread, 2.0)) * noise * noise;
}

}  // namespace

RestingPlace resting_place(const MotorTrace& trace, const signals::SignalFacts& facts,
                           std::span<const RestBeforeFlight> passages) {
  const double least = facts.least_way();
  const std::vector<RestBeforeFlight> some = spread(passages);
  std::vector<RestBeforeFlight> seen;
  std::size_t rubbing = 0;
  for (const RestBeforeFlight& p : some) {
    if (p.core < p.begin + signals::MotionLaw::kFewestRows) continue;
    const bool rubs = rubs_to_rest(trace, p, least);
    seen.push_back(p);
    rubbing += rubs;
  }
  if (seen.empty()) return RestingPlace::kUntold;
  std::vector<signals::LawStretch> flights;
  for (const auto& p : seen) flights.push_back(flight_stretch(p));
  const signals::MotionLaw alone(trace, flights, signals::MotionLaw::Friction::kPassive);
  std::vector<double> held;
  for (const auto& p : seen) held.push_back(held_back(trace, p.rest, alone.drive(), alone.dry()));
  if (median(held) > least) return RestingPlace::kAtLoad;
  const double noise = std::max(alone.rms(), facts.noise);
  std::optional<RestingPlace> nearest;
  for (const double share : kArrivals) {
    const Arrivals a = arrivals(trace, seen, share, least);
    if (!(a.rows > 0.0)) continue;
    const double left = left_by_one_law(trace, alone, flights, a);
    const bool followed = left * left < kFollows * noise * noise;
    if (a.way >= kTellsAlone * a.rise && (followed || 2 * rubbing >= seen.size()) &&
        can_be_alone(trace, facts, alone, a))
      return RestingPlace::kAlone;
    const bool departs = !followed && left > kOwnBending * a.way / static_cast<double>(a.stretches.size());
    if (!nearest) nearest = departs ? RestingPlace::kAtLoad : RestingPlace::kUntold;
  }
  return nearest.value_or(RestingPlace::kUntold);
}

}  // namespace gapscope::internal::sliding_mode
