#include "sliding_mode/verdict/pooled_reading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "sliding_mode/passage/passage.h"
#include "sliding_mode/verdict/pool.h"
#include "sliding_mode/verdict/pooled_flights.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kFirstTried = 12.0;  ///< quanta
constexpr double kNextTried = 1.05;   ///< over the one before
/// Of the gap that is tried: where its kink is sought, and where it counts. A weak impact shows in what
/// follows it, so it may lie far before the end of the window.
constexpr double kNearest = 0.64, kFarthestKink = 1.12, kNear = 0.67, kFar = 1.1;
/// … and where it decides: in longer windows cogging without a gap takes a kink, too (3602002 gap_free
/// trapezoid: 7 in χ² up to here, 39 at 0.78, 290 at 0.7). Of 70 gap_free sines and 49 trapezoids no other
/// reached 8 (3601001 and 3602001). 871001 150 gap sine: 64 told before these windows, 70 after.
/// Half and double, on 44 sines of 4100001 222 (eight told, 36 at rest with 15 to 150 counts) and 16
/// trapezoids without a gap (3602001): kDecides 0.4 tells three more, one of them 8 % off and outside its
/// interval, and a gap where there is none; 1 loses four. kNear 0.34 loses one, kKinkShows 3 and 12 change
/// nothing.
constexpr double kDecides = 0.8;
constexpr double kMostPassages = 0.6;      ///< of the changes of the torque's sign
constexpr std::size_t kFewestFlights = 2;  ///< each way
constexpr double kFewestFreedom = 20.0;    ///< rows less columns
constexpr std::size_t kFewestWindows = 3;  ///< that agree

// Set on drives of the independent plant: study_sliding_mode 700001 300 gap sine, 3610001 120 gap trapezoid,
// 3620001 210 gap_free sine. Looked at since, on ten right answers of 830001 200 gap sine, 3330001 80 and
// 3320001 60 gap trapezoid: kLaw 1.15 loses one, 1.6 takes their mean error from 3.9 to 3.8 %; kRival 0.6
// nothing.
constexpr double kLaw = 1.3;             ///< mean square that law and kink may leave, over the noise's
constexpr double kKinkStandsOut = 15.0;  ///< χ² that a kink takes beyond any smooth departure (10, 40 tried)
constexpr double kKinkShows = 6.0;       ///< … in a window that agrees with a clearer one
constexpr double kLeastLoss = 0.1;       ///< of the mean speed of the passage, lost at its end
constexpr double kMostBeyond = 0.1;      ///< of the gap: x1 has left its farthest place without torque
/// Of the gap: x1 still goes on where the torque vanishes, so its load need not be in touch when it has come
/// to rest. Loads at rest show 0 to 0.07, loads that coast 0.11 and 0.48 (830001 200 gap sine, 3330001 80 gap
/// trapezoid).
constexpr double kMostSlid = 0.08;
constexpr double kRival = 0.3;   ///< of the clearest kink's χ²: as clear as that
constexpr double kSame = 0.15;   ///< of the gap: two windows read the same
constexpr double kAlmost = 4.0;  ///< χ²
constexpr double kDoubt = 0.5;   ///< standard deviation, over what shapes and windows differ by
/// Standard deviation, over the gap: contacts and bounces are no kink of the shapes that are tried. Of 16
/// families with other laws (study_trust all 1 24 reading; two gaps in series apart) its intervals hold 17 of
/// 19, with 0.03, which the plant's own contacts ask for, 15; double would hold 18, 20 % wide to either side.
constexpr double kImpactLaw = 0.05;
constexpr double kRounding = 0.3;  ///< standard deviation of the level of rest, in quanta
/// Counts in a gap that is told. Below it three of ten are off by three standard deviations, above it none of
/// 59 (830001 200, 840001 200, 860001 150, 810301 120 gap sine; 3320001 60, 3330001 80 gap trapezoid; 3331001
/// 80 multisine).
constexpr double kFewestPooledQuanta = 25.0;
/// That agree on a gap of fewer counts. Of 50 sines of 4100001 600 with 16 to 27 counts half (3) tells
/// nothing more: two reach it (4100164 and 4100326, 8 % too small and 5 % too large), their intervals reach
/// below 20 counts. Double loses the only one told (4100207, 7 windows, 1.4 % off).
constexpr std::size_t kManyWindows = 5;
constexpr double kSurelyFree = 0.9;  ///< of the gap: until there the motor surely flies

/// What the window that ends behind one tried gap shows. All in rad but stands_out.
struct GapCandidate {
  double tried = 0.0, gap = kNaN;
  double low = 0.0, high = 0.0;  ///< where kinks of other shapes fit almost as well
  double stands_out = 0.0;       ///< χ² that the kink takes beyond any smooth departure
  double beyond = 0.0;           ///< how far x1 goes on after the zero of the torque
  double slid = 0.0;             ///< how far x1 goes on while the torque vanishes
  KinkShape shape;
  bool brakes = false;
  double doubt = 0.0;       ///< of the gap, by the shape of the kink and the length of the window
  std::size_t windows = 1;  ///< that agree

  bool decides() const { return stands_out >= kKinkStandsOut && gap >= kDecides * tried; }
};

struct PooledRecording {
  const MotorTrace& trace;
  const signals::SignalFacts& facts;
  std::vector<TorqueTurn> turns;
};

/// A rigid impact, short strokes and bounces.
std::vector<KinkShape> abrupt_shapes(double duration) {
  std::vector<KinkShape> shapes{{1}};
  for (double half_period = 2.0; half_period < 0.2 * duration; half_period *= 1.7)
    shapes.push_back({0, kPi / half_period, 0.1});
  for (double fading = 2.0; fading < 0.2 * duration; fading *= 2.5)
    shapes.push_back({0, 0.0, 0.0, 0.5, 1.0 / fading});
  return shapes;
}

double median_of(const PooledFlights& flights, double PooledStretch::*member) {
  std::vector<double> values;
  for (const PooledStretch& s : flights.stretches()) values.push_back(s.*member);
  return median(std::move(values));
}

PooledFlights::Onset onset_of(bool brakes) {
  return brakes ? PooledFlights::Onset::kBraked : PooledFlights::Onset::kImpact;
}

/// The kinks of all shapes that fit almost as well.
void widen(const PooledFlights& flights, std::span<const PooledKink> kinks, double limit, double step,
           GapCandidate& c) {
  c.low = c.high = c.gap;
  for (const PooledKink& k : kinks) {
    if (k.sse > limit) continue;
    c.low = std::min(c.low, k.gap), c.high = std::max(c.high, k.gap);
    for (const double way : {-step, step})
      for (double g = k.gap + way;
           std::abs(g - k.gap) < 0.15 * k.gap && flights.trial(k.shape, onset_of(k.brakes), g).sse < limit;
           g += way)
        c.low = std::min(c.low, g), c.high = std::max(c.high, g);
  }
}

PooledKink best_near(const PooledFlights& flights, const KinkShape& shape, bool brakes, double gap) {
  return flights.best(shape, onset_of(brakes), kNearest * gap, kFarthestKink * gap, 0.025 * gap);
}

std::optional<GapCandidate> try_gap(const PooledRecording& s, double gap) {
  const PooledFlights flights(s.trace, s.turns, s.facts.noise, gap);
  const auto asked = kMostPassages * static_cast<double>(s.turns.size());
  if (static_cast<double>(flights.passages()) < asked || flights.passages() < 2 * kFewestFlights ||
      flights.freedom() < kFewestFreedom)
    return {};
  std::vector<PooledKink> kinks;
  for (const KinkShape& shape : abrupt_shapes(flights.duration()))
    for (const bool brakes : {false, true})
      if (!brakes || shape.first == 0.0)  // bounces brake
        kinks.push_back(best_near(flights, shape, brakes, gap));
  const auto best = std::ranges::min_element(kinks, {}, &PooledKink::sse);
  const double noise = s.facts.noise * s.facts.noise, speed = gap / flights.duration();
  const double left = best->sse / flights.freedom() / noise;
  if (left > kLaw || -best->amplitude < kLeastLoss * speed || best->gap < kNear * gap ||
      best->gap > kFar * gap)
    return {};
  const double smooth = std::min(
      {flights.smooth_sse(),
       flights.best({2}, PooledFlights::Onset::kAny, 0.5 * gap, kFarthestKink * gap, 0.04 * gap).sse,
       flights.best({3}, PooledFlights::Onset::kAny, 0.3 * gap, kFarthestKink * gap, 0.04 * gap).sse});
  GapCandidate c;
  c.tried = gap, c.gap = best->gap, c.shape = best->shape, c.brakes = best->brakes;
  c.stands_out = (smooth - best->sse) / noise / s.facts.sharing(speed);
  if (c.stands_out < kKinkShows) return {};
  c.beyond = median_of(flights, &PooledStretch::beyond);
  c.slid = median_of(flights, &PooledStretch::slid);
  widen(flights, kinks, best->sse + kAlmost * noise * std::max(1.0, left) * s.facts.sharing(speed),
        0.005 * gap, c);
  return c;
}

double median_over(std::span<const GapCandidate> candidates, double GapCandidate::*member) {
  std::vector<double> values;
  for (const GapCandidate& c : candidates) values.push_back(c.*member);
  return median(std::move(values));
}

/// The window in the middle of them, with what all of them say.
GapCandidate middle_of(std::span<const GapCandidate> group) {
  const double gap = median_over(group, &GapCandidate::gap);
  GapCandidate middle =
      *std::ranges::min_element(group, {}, [gap](const GapCandidate& c) { return std::abs(c.gap - gap); });
  middle.gap = gap, middle.windows = group.size();
  middle.beyond = median_over(group, &GapCandidate::beyond);
  middle.slid = median_over(group, &GapCandidate::slid);
  const double shapes = std::max(
      {median_over(group, &GapCandidate::high) - gap, gap - median_over(group, &GapCandidate::low), 0.0});
  std::vector<double> gaps;
  for (const GapCandidate& c : group) gaps.push_back(c.gap);
  middle.doubt = std::hypot(shapes, 0.5 * (quantile(gaps, 0.9) - quantile(gaps, 0.1)));
  return middle;
}

/// What windows of several lengths agree on. Nothing where only one shows a kink (then a longer or shorter
/// one contradicts it), or where one as clear shows another.
std::optional<GapCandidate> agreed(const PooledRecording& s) {
  std::vector<GapCandidate> found;
  const double least = std::max(kFirstTried * s.facts.quantum, s.facts.least_way());
  for (double gap = least; gap < kMostOfTravel * s.facts.travel; gap *= kNextTried)
    if (const auto c = try_gap(s, gap)) found.push_back(*c);
  if (found.empty()) return {};
  const double clearest = std::ranges::max_element(found, {}, &GapCandidate::stands_out)->stands_out;
  std::vector<double> clear;
  for (const GapCandidate& c : found)
    if (c.stands_out > kRival * clearest) clear.push_back(c.gap);
  const double typical = median(std::move(clear));
  std::vector<GapCandidate> group;
  for (const GapCandidate& c : found) {
    if (std::abs(c.gap - typical) < kSame * typical)
      group.push_back(c);
    else if (c.stands_out > kRival * clearest)
      return {};
  }
  if (group.size() < kFewestWindows) return {};
  if (std::ranges::none_of(group, &GapCandidate::decides)) return {};
  return middle_of(group);
}

/// The same kink in the passages of one direction.
PooledKink one_way(const PooledRecording& s, const GapCandidate& c, int direction) {
  std::vector<TorqueTurn> turns;
  for (const TorqueTurn& t : s.turns)
    if (t.direction == direction) turns.push_back(t);
  const PooledFlights flights(s.trace, turns, s.facts.noise, c.tried);
  if (flights.passages() < kFewestFlights || flights.freedom() < kFewestFreedom)
    return {c.shape, c.brakes, kNaN};
  return best_near(flights, c.shape, c.brakes, c.tried);
}

/// The rest that each passage begins from, and its flight.
std::vector<RestBeforeFlight> rests_of(const PooledRecording& s, const GapCandidate& c) {
  const PooledFlights flights(s.trace, s.turns, s.facts.noise, c.tried);
  const double tolerance = s.facts.quantum + 2.0 * s.facts.noise;
  std::vector<RestBeforeFlight> rests;
  for (const PooledStretch& stretch : flights.stretches()) {
    std::size_t first = stretch.turn.zero;
    while (first > 0 && std::abs(s.trace.x1[first] - stretch.rest) <= tolerance) --first;
    const double end = flights.crossing(stretch, kSurelyFree * c.gap);
    if (std::isnan(end)) continue;
    rests.push_back({{stretch.turn.direction, first, stretch.turn.zero, stretch.rest, c.gap},
                     stretch.first,
                     static_cast<std::size_t>(end)});
  }
  return rests;
}

void keep_events(const PooledRecording& s, const GapCandidate& c, GapEvidence& evidence) {
  const PooledFlights flights(s.trace, s.turns, s.facts.noise, c.tried);
  for (const PooledStretch& stretch : flights.stretches()) {
    GapEvent event;
    event.file = s.trace.file;
    event.direction = stretch.turn.direction;
    event.t1 = s.trace.time(stretch.turn.quiet);  // a contact without torque is lost, however long that stays
    event.t2 = s.trace.start + s.trace.dt * flights.crossing(stretch, c.gap);
    event.x1_t1 = stretch.rest - stretch.turn.direction * stretch.beyond;
    event.x1_t2 = stretch.rest + stretch.turn.direction * c.gap;
    event.gap = event.gap_uncorrected = c.gap + stretch.beyond;
    event.std = evidence.parts.together();
    event.remark = "read together with the others";
    evidence.events.push_back(event);
  }
}

std::optional<GapEvidence> read_one(const MotorTrace& trace, const signals::SignalFacts& facts) {
  if (!facts.defect.empty() || !(facts.quantum > 0.0)) return {};
  const PooledRecording s{trace, facts, torque_turns(trace)};
  const auto c = agreed(s);
  if (!c || c->beyond > kMostBeyond * c->gap || c->slid > kMostSlid * c->gap) return {};
  if (resting_place(trace, facts, rests_of(s, *c)) == RestingPlace::kAlone) return {};
  const double up = one_way(s, *c, 1).gap, down = one_way(s, *c, -1).gap;
  if (std::isnan(up) || std::isnan(down)) return {};
  GapEvidence e;
  e.gap = c->gap + c->beyond;
  e.quantum = facts.quantum;
  e.parts.systematic = std::hypot(kDoubt * c->doubt, kImpactLaw * e.gap, 0.5 * c->beyond);
  e.parts.directions = 0.5 * std::abs(up - down);
  e.parts.noise = kRounding * facts.quantum;
  const bool few = e.gap < kFewestPooledQuanta * facts.quantum;
  if (few && c->windows < kManyWindows) return {};
  // 18 counts may be read as 21 (4100155 gap sine), so the whole interval has to lie where gaps are told.
  if (e.gap - kNormal95 * e.parts.together() < signals::kFewestToldQuanta * facts.quantum) return {};
  e.smallest_visible_gap = few ? kNaN : kFewestPooledQuanta * facts.quantum;
  keep_events(s, *c, e);
  e.tested = {{words::single_passages(), false}};
  e.presumes = {words::one_gap(), words::load_rests(), words::own_encoder()};
  e.reading = words::flights_together(std::ssize(e.events), std::ssize(s.turns));
  return e;
}

}  // namespace

std::optional<GapEvidence> read_pooled(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts) {
  return narrowest(recordings, facts, read_one);
}

}  // namespace gapscope::internal::sliding_mode
