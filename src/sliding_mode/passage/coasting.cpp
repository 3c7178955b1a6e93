#include "sliding_mode/passage/coasting.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gapscope/base/statistics.h"
#include "signals/motion_law.h"
#include "sliding_mode/passage/release.h"
#include "sliding_mode/passage/turn.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kSkipped[] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7};  ///< of the time in contact: for bounces
constexpr double kHolds = 1.15;                                ///< what a law leaves over, over the noise
/// Of the gap: what bounces that are left may move it by. Of 4100296 and 5801001 80 gap sine half reads none
/// by laws that ring, this 4100296 and double 5801077 as well (0.8 and 0.3 % off, within their intervals).
constexpr double kFaded = 0.05;
constexpr double kBeforeImpact = 0.05;      ///< of the flight, left out at its end
constexpr std::size_t kFewestTogether = 4;  ///< passages
constexpr std::size_t kGroups = 4;          ///< of passages, left out in turn
/// Of the travel of a load whose law is not seen: a half width. A contact that rings until t1 is lost in a
/// rebound, with less speed of the load than the motor shows (810371 gap sine: 0.35 of the travel).
constexpr double kUnknownTravel = 0.35;
constexpr double kToldTravel = 0.1;  ///< of the gap: travel that is told though no law of the load is seen
/// Half width, over the load's way or, if less, what friction takes of it: the law of the load that coasts is
/// not seen, but made of two laws of the motor, and its friction is none of dry and viscous alone. Of two
/// loads with LuGre and Stribeck friction the way came out 0.15 and 0.24 short, which this does not hold:
/// kKnownLoss keeps such readings from being good. 0.25 refuses loads of the tests that are read right.
constexpr double kTravelDoubt = 0.1;
/// Of the gap: what friction takes of the load's way, for the law to be called known; 0.25 of it is an
/// eighth.
constexpr double kKnownLoss = 0.5;
/// Half width, over what the unwinding adds: ω is known to a third. Half and this hold five of five gap sine,
/// double tells three; of six with a contact 0.4 times as stiff these miss 4100002 (5.6 % off), double none.
constexpr double kSpringDoubt = 2.0;

/// A passage, and the stretches before and in it that the laws are fitted to.
struct Coasting {
  Passage* passage;
  signals::LawStretch engaged, flight;
};

double sample_of(const MotorTrace& trace, double time) { return (time - trace.start) / trace.dt; }

/// From where x1 moves steadily against the passage, once the bounces of the impact at t2 [s] have faded, to
/// t1.
std::optional<signals::LawStretch> in_contact(const MotorTrace& trace, double t2, const Passage& t,
                                              double skipped) {
  const double since = sample_of(trace, t2), end = sample_of(trace, t.t1_first);
  if (!(since > 0.0) || !(end > since + signals::MotionLaw::kFewestRows)) return {};
  const auto last = static_cast<std::size_t>(end);
  const auto turn =
      static_cast<double>(farthest(trace, static_cast<std::size_t>(since), last, t.event.direction));
  const auto first = static_cast<std::size_t>(turn + skipped * (end - turn));
  if (last < first + signals::MotionLaw::kFewestRows) return {};
  return signals::LawStretch{first, last, static_cast<double>(first), -t.event.direction};
}

std::optional<signals::LawStretch> in_flight(const MotorTrace& trace, const Passage& t) {
  const double t1 = sample_of(trace, t.t1_last), t2 = sample_of(trace, t.event.t2);
  const double end = t2 - std::max(2.0, kBeforeImpact * (t2 - t1));
  if (!(t1 > 0.0) || !(end > t1 + signals::MotionLaw::kFewestRows + 2.0)) return {};
  const std::size_t first = static_cast<std::size_t>(t1) + 2, last = static_cast<std::size_t>(end);
  const std::size_t latest = farthest(trace, first, last, -t.event.direction);
  return signals::LawStretch{first, last, turn_within(trace, first, latest, last), t.event.direction};
}

/// Both ends of the flight are known, and only what the load did meanwhile was in doubt.
bool may_coast(const Passage& t) {
  const bool in_doubt = t.refusal == Refusal::kNone || t.refusal == Refusal::kNoRelease ||
                        t.refusal == Refusal::kLoadMoving || t.refusal == Refusal::kThrownOff;
  return t.released() && in_doubt;
}

std::vector<Coasting> stretches(const MotorTrace& trace, std::vector<Passage>& passages, double skipped) {
  std::vector<Coasting> found;
  for (std::size_t i = 1; i < passages.size(); ++i) {
    Passage& t = passages[i];
    if (!may_coast(t)) continue;
    const auto engaged = in_contact(trace, passages[i - 1].event.t2, t, skipped),
               flight = in_flight(trace, t);
    if (engaged && flight) found.push_back({&t, *engaged, *flight});
  }
  return found;
}

/// The laws of both bodies together and of the motor alone, and what follows for the load.
struct Laws {
  signals::MotionLaw together, alone;
  double stiffness = 0.0;  ///< of the spring between them, over the motor's inertia; 0: rigid [1/s²]

  double ratio() const { return alone.drive() / together.drive() - 1.0; }
  /// Deceleration of the load alone that does not depend on its speed, and what is proportional to it.
  double dry() const { return of_load(together.dry(), alone.dry()); }
  double viscous() const { return of_load(together.viscous(), alone.viscous()); }

  /// By how much a load that the motor drove is faster than it at t1 [samples], where the spring between them
  /// lets go: the torque of the contact is what keeps the motor from its law alone [rad/s].
  double unwinding(const MotorTrace& trace, const Coasting& c, std::size_t k, double t1,
                   double flight) const {
    const auto held_back = [&](double time) {  // acceleration [rad/s²]
      const auto i = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
      const double w = together.state(k, time).speed, u = trace.u[std::min(i, trace.size() - 1)];
      return (alone.drive() - together.drive()) * u - (alone.viscous() - together.viscous()) * w;
    };
    if (!(stiffness > 0.0)) return 0.0;
    const double before = std::max(1.0, kBeforeImpact * flight);
    const double rate = (held_back(t1) - held_back(t1 - before)) / (before * trace.dt);
    return c.passage->event.direction * rate / stiffness;
  }

  /// How far a load that still bounces, as `left` [rad] over the law tells, may get from where it would be by
  /// its law [rad].
  double rebound(const Coasting& c, double left) const {
    if (!(stiffness > 0.0) || !(ratio() > 0.0)) return kInfinity;
    const double bounces = std::sqrt(2.0 * std::max(left * left - alone.rms() * alone.rms(), 0.0));
    const double both = 1.0 + 1.0 / ratio();  // on the spring, over the motor alone
    return bounces * std::sqrt(stiffness * both) * both * (c.passage->event.t2 - c.passage->event.t1);
  }

 private:
  double of_load(double both, double motor) const { return ((1.0 + ratio()) * both - motor) / ratio(); }
};

struct LoadWay {
  double gap = kNaN, travel = kNaN;  ///< [rad]
  double speed = kNaN;               ///< of the load at t2, against the passage [rad/s]
  double lost = kNaN;                ///< of the way at its first speed, to its friction [rad]
  double open = 0.0;  ///< between dry and viscous friction alone, where the laws tell neither [rad]
};

/// The k-th passage, if its contact was lost at t1 [s].
LoadWay way(const MotorTrace& trace, const Laws& laws, const Coasting& c, std::size_t k, double t1) {
  const GapEvent& e = c.passage->event;
  const signals::MotorState at = laws.together.state(k, sample_of(trace, t1));
  const double flight = (e.t2 - t1) / trace.dt, dry = laws.dry(), viscous = laws.viscous();
  const double w = -e.direction * at.speed + laws.unwinding(trace, c, k, sample_of(trace, t1), flight);
  const double slowing = dry + viscous * w;
  LoadWay result;
  if (!(laws.ratio() > 0.0) || !(slowing > 0.0) || !(w > 0.0)) return result;
  const double D = e.t2 - t1;
  const auto travel = [&](double viscous_share) { return load_travel(w, slowing, D, viscous_share); };
  // Neither friction drives: what the laws tell about the share of each beyond that is their error.
  const double share = viscous * w / slowing, passive = std::clamp(share, 0.0, 1.0);
  result.travel = travel(passive);
  result.lost = w * D - result.travel;
  result.speed = (result.travel - load_travel(w, slowing, D - trace.dt, passive)) / trace.dt;
  if (share != passive) result.open = travel(1.0) - travel(0.0);
  result.gap = e.direction * (e.x1_t2 - at.position) + result.travel;
  return result;
}

/// Of the passages that the laws can read.
std::vector<double> gaps(const MotorTrace& trace, const Laws& laws, const std::vector<Coasting>& all) {
  std::vector<double> values;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double gap = way(trace, laws, all[k], k, all[k].passage->event.t1).gap;
    if (!std::isnan(gap)) values.push_back(gap);
  }
  return values;
}

/// Standard deviation of the gap by what the laws are not known to: every group of passages is left out in
/// turn.
double doubt_of_laws(const MotorTrace& trace, const Laws& laws, const std::vector<Coasting>& all) {
  std::vector<double> medians;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Laws rest{laws.together.without(g, kGroups), laws.alone.without(g, kGroups), laws.stiffness};
    medians.push_back(median(gaps(trace, rest, all)));
  }
  double mean = 0.0, square = 0.0;
  for (const double m : medians) mean += m / kGroups;
  for (const double m : medians) square += (m - mean) * (m - mean);
  return std::sqrt(square * (kGroups - 1.0) / kGroups);
}

void write_way(const MotorTrace& trace, const Laws& laws, const Coasting& c, std::size_t k, double doubt) {
  Passage& t = *c.passage;
  const LoadWay best = way(trace, laws, c, k, t.event.t1);
  if (std::isnan(best.gap)) return;
  Laws rigid = laws;
  rigid.stiffness = 0.0;
  const auto differs = [&](const LoadWay& other) {  // a load that rested then has travelled nothing
    return std::isnan(other.gap) ? best.travel : std::abs(other.gap - best.gap);
  };
  const double spring = differs(way(trace, rigid, c, k, t.event.t1));
  const double t1 =
      std::max(differs(way(trace, laws, c, k, t.t1_first)), differs(way(trace, laws, c, k, t.t1_last)));
  t.event.gap = best.gap;
  t.load_travel = best.travel;
  t.speed = std::abs(t.speed + best.speed);
  t.half_width =
      std::hypot(t.speed * t.t2_half_width + t1, std::hypot(doubt, 0.5 * best.open),
                 std::hypot(kSpringDoubt * spring, kTravelDoubt * std::min(best.travel, best.lost)));
  t.dwell = false;
  t.by_law = true;
  t.untold = std::min(best.travel, best.lost) > kKnownLoss * best.gap;
  t.event.remark = "corrected for the travel of the load";
  refuse(t, best.gap > 0.0 ? Refusal::kNone : Refusal::kLoadMoving);
}

/// All passages with the laws of both stretches, where these hold.
struct LawReading {
  std::vector<Coasting> passages;
  Laws laws;
  bool rings = false;  ///< beyond the noise

  double gap(const MotorTrace& trace) const { return median(gaps(trace, laws, passages)); }
};

Laws laws_of(const MotorTrace& trace, const std::vector<Coasting>& all) {
  std::vector<signals::LawStretch> engaged, flights;
  std::vector<double> stiffnesses;
  for (const Coasting& c : all) {
    engaged.push_back(c.engaged), flights.push_back(c.flight);
    stiffnesses.push_back(c.passage->stiffness);
  }
  return {{trace, std::move(engaged)}, {trace, std::move(flights)}, median(std::move(stiffnesses))};
}

/// Laws of the passages before which the bounces have faded.
/// @param faded  of the gap: what bounces that are left may move it by; 0: they are within the noise
std::optional<LawReading> fit_laws(const MotorTrace& trace, const signals::SignalFacts& facts,
                                   const std::vector<Coasting>& all, double faded) {
  const Laws every = laws_of(trace, all);
  const double most = kHolds * std::max(every.alone.rms(), facts.quantum / std::sqrt(12.0));
  const auto has_faded = [&](const Laws& laws, const Coasting& c, std::size_t k, double left) {
    return left <= most ||
           (faded > 0.0 && laws.rebound(c, left) <= faded * way(trace, laws, c, k, c.passage->event.t1).gap);
  };
  std::vector<Coasting> quiet;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (has_faded(every, all[k], k, every.together.own_rms(k))) quiet.push_back(all[k]);
  if (quiet.size() < kFewestTogether) return {};
  Laws laws = laws_of(trace, quiet);
  if (laws.alone.rms() > kHolds * facts.noise) return {};
  if (!has_faded(laws, quiet.front(), 0, laws.together.rms())) return {};
  LawReading reading{std::move(quiet), std::move(laws), faded > 0.0};
  if (std::isnan(reading.gap(trace))) return {};
  return reading;
}

/// Where bounces last until t1, both sides of the contact share no speed then, and the travel of the load is
/// not known.
void doubt_travel(Passage& t) {
  if (t.by_law || t.dwell) return;
  t.half_width = std::hypot(t.half_width, kUnknownTravel * std::max(t.load_travel, 0.0));
}

/// Beside passages that are read by the laws, one that rings says nothing.
void leave_out(Passage& t) {
  const bool answers = t.refusal == Refusal::kNone || t.refusal == Refusal::kLoadMoving;
  if (answers && !t.by_law && !t.dwell && t.load_travel > kToldTravel * t.event.gap)
    refuse(t, Refusal::kThrownOff);
}

/// @param apart  by what the gap differs from that after a shorter wait for the bounces [rad]
void write_all(const MotorTrace& trace, const LawReading& reading, double apart) {
  const double doubt = std::hypot(doubt_of_laws(trace, reading.laws, reading.passages), apart);
  for (std::size_t k = 0; k < reading.passages.size(); ++k) {
    const Coasting& c = reading.passages[k];
    const double bounces = reading.rings ? reading.laws.rebound(c, reading.laws.together.own_rms(k)) : 0.0;
    write_way(trace, reading.laws, c, k, std::hypot(doubt, std::isfinite(bounces) ? bounces : 0.0));
  }
}

/// Those of which the load moves; all where most are of that kind, since a slow load is hard to tell from one
/// at rest.
std::vector<Coasting> moving(std::vector<Coasting> all) {
  const auto rests = [](const Coasting& c) { return c.passage->dwell; };
  if (2 * std::ranges::count_if(all, rests) >= std::ssize(all)) std::erase_if(all, rests);
  return all;
}

bool read_by_laws(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<Passage>& passages,
                  double faded) {
  std::optional<LawReading> before;
  for (const double skipped : kSkipped) {
    const std::vector<Coasting> all = moving(stretches(trace, passages, skipped));
    if (all.size() < kFewestTogether) return false;
    std::optional<LawReading> now = fit_laws(trace, facts, all, faded);
    if (before && now) {
      write_all(trace, *now, now->gap(trace) - before->gap(trace));
      return true;
    }
    before = std::move(now);
  }
  return false;
}

}  // namespace

void read_coasting(const MotorTrace& trace, const signals::SignalFacts& facts,
                   std::vector<Passage>& passages) {
  const auto read = [&](double faded) { return read_by_laws(trace, facts, passages, faded); };
  if (read(0.0) || read(kFaded)) std::ranges::for_each(passages, leave_out);
  std::ranges::for_each(passages, doubt_travel);
}

}  // namespace gapscope::internal::sliding_mode
