#include "sliding_mode/passage/passage.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "sliding_mode/passage/coasting.h"
#include "sliding_mode/passage/flight.h"
#include "sliding_mode/passage/impact_time.h"
#include "sliding_mode/passage/pushed_load.h"
#include "sliding_mode/passage/release.h"
#include "sliding_mode/passage/turn.h"

namespace gapscope::internal::sliding_mode {

namespace {

constexpr double kContradiction = 0.06;  ///< of the gap: between the states just before and just after t1
constexpr double kContrast = 1.6;        ///< of the impact, over what the motion before it needs
constexpr double kRebound = 0.25;        ///< of the flight, from the impact before to its begin
constexpr double kReach = 0.8;           ///< of a half period: nothing before it belongs to the flight

/// Of the gap: the way of a load that goes along with the motor at t1, if it kept its speed until t2; and of
/// that the way from the turn to t1, in contact: a spring that unwinds gives the motor its speed on less. Of
/// study_sliding_mode 5610001 30 gap triangle wide held, 5610101 20 trapezoid it leaves no error above 10 %;
/// half takes three right readings more, double leaves an error of 72 %, and 0.1 refuses a soft contact of
/// the tests. None of them changes a reading of 5410001 40 gap triangle wide or trapezoid wide, whose loads
/// rest.
constexpr double kGoesAlong = 0.15;

constexpr double kFewestBeforeTurn = 12.0;  ///< samples by which a law knows both sides of a turn

/// Of the range of u, within a few samples: a step, whose jolt may be its own. Asking every motor to be
/// driven on in its place takes 24 bounds of 93 that hold; half and double were not tried.
constexpr double kStepOfInput = 0.1;

constexpr std::size_t kSpeeds = 20;  ///< of a stroke, each a mean over its part

/// Samples at one place before t1 that make a rest. Of study_sliding_mode 6700001 60 gap triangle rubs and
/// 6700101 60 gap sine rubs it reads three more than without; half and double read the same.
constexpr std::size_t kRested = 12;

/// Where x1 turned round before the impact, against the direction of the passage.
Reversal find_reversal(const PassageContext& context, int direction, std::size_t from, std::size_t to) {
  Reversal r;
  r.direction = direction;
  const auto& y = context.trace.x1;
  double low = kInfinity;
  for (std::size_t i = from; i <= to; ++i)
    if (direction * y[i] <= low) low = direction * y[i], r.last = i;
  const double tolerance = context.facts.quantum + 2.0 * context.facts.noise;
  r.first = r.last;
  for (std::size_t i = r.last; i-- > from && direction * y[i] <= low + tolerance;) r.first = i;
  r.position = direction * low;
  r.rise = direction * y[to] - low;
  return r;
}

/// The motor goes the other way all the time, farther than noise and counting feign: a load that overtakes it
/// has crossed the gap.
bool goes_on(const PassageContext& context, int direction, std::size_t from, std::size_t to) {
  const auto& y = context.trace.x1;
  const double most = *std::max_element(y.begin() + from, y.begin() + to + 1,
                                        [&](double a, double b) { return direction * a < direction * b; });
  return direction * (most - y[to]) > context.facts.least_way();
}

/// Nothing before it belongs to the flight that ends in an impact [samples].
std::size_t flight_begin(const PassageContext& context, const BankEvent& impact) {
  const auto reach = static_cast<std::size_t>(kReach * context.facts.half_period / context.trace.dt);
  return impact.start - std::min(impact.start, reach);
}

signals::LawStretch flight_window(const PassageContext& context, const BankEvent& impact, const Reversal& r,
                                  const Turn& turn) {
  const std::size_t first = flight_begin(context, impact);
  const std::size_t after = (impact.start - r.last) / 4 + 3 * impact.latency + 2;
  const std::size_t last = std::min(impact.start + after, context.trace.size() - 1);
  return {first, last, std::max(turn.time, static_cast<double>(first)), r.direction, turn.bend};
}

/// The law of a flight, and the impact that ends it. A motor whose flight began before it turned round obeys
/// one law on both sides of the turn, in which its dry friction changes its sign at an instant that has to be
/// known to a fraction of a sample. One that left the load at rest has nothing before the turn to tell it by:
/// its last sample at the extremum will do.
struct Flight {
  std::unique_ptr<const FlightLaw> law;
  ImpactTime impact;
};

Flight flight_of(const PassageContext& context, const BankEvent& event, const Reversal& r) {
  const auto with = [&](const Turn& turn) {
    Flight flight{std::make_unique<const FlightLaw>(context.trace, flight_window(context, event, r, turn),
                                                    context.facts.noise),
                  {}};
    flight.impact = refine_impact(context, event, r, *flight.law);
    return flight;
  };
  Flight from_rest = with({static_cast<double>(r.last)});
  if (!from_rest.impact.found) return from_rest;
  const double way = std::max(kTurnWay * r.rise, context.facts.least_way());
  const double guess = turn_time(context.trace, r.first, r.last, way);
  const auto before = static_cast<std::size_t>(std::max(guess - kFewestBeforeTurn, 0.0));
  const Turn turn =
      before + 3 * signals::MotionLaw::kFewestRows < from_rest.impact.core
          ? turn_by_law(context.trace, before, from_rest.impact.core, guess, r.direction, context.facts.noise)
          : Turn{guess};
  Flight through = with(turn);
  FlightLaw::Fit law;
  const bool holds = through.impact.found && through.law->fit_before(through.impact.core, law) &&
                     static_cast<double>(law.first) < turn.time &&
                     r.direction * (context.trace.x1[law.first] - r.position) > context.facts.least_way();
  return holds ? std::move(through) : std::move(from_rest);
}

void fill_event(Passage& t, const PassageContext& context, const ImpactTime& impact, const Release& release) {
  const auto& trace = context.trace;
  t.event.t1 = trace.start + trace.dt * release.time;
  t.event.x1_t1 = release.position;
  const double s5 = t.event.direction * (impact.position - release.position);
  t.event.gap_uncorrected = std::abs(s5);
  t.event.gap = s5 + release.load_travel;
  t.load_travel = release.load_travel;
  t.t1_first = trace.start + trace.dt * release.first;
  t.t1_last = trace.start + trace.dt * release.last;
  t.t2_half_width = impact.half_width;
  t.half_width = release.half_width + std::abs(impact.speed) * impact.half_width;
  t.dwell = release.dwell;
  if (release.load_travel > 0.0) t.event.remark = "corrected for the travel of the load";
}

/// Where motor and load part while both go along the passage something other than the motor moves the load,
/// such as an elastic friction that springs back, and its way until t2 is not known.
/// @returns that way if it keeps its speed [rad]
double way_along(const Passage& t, const Release& release, const Reversal& r, double least_way) {
  const double way = release.along * (t.event.t2 - t.event.t1);
  const double together = t.event.direction * (release.position - r.position) - least_way;
  return t.dwell && together > kGoesAlong * way ? std::max(way, 0.0) : 0.0;
}

/// Whether the motor stood before the passage: its own friction held it then, which no law of a moving motor
/// has, and x1 does not tell from which flank that law departs.
bool rested(const Reversal& r, const Release& release) {
  return r.last - r.first >= kRested && release.time > static_cast<double>(r.first + kRested);
}

/// A motor that its own friction held leaves from where it stood: in contact it could only drag the load
/// along, and what has unwound of the contact until it moves is no more than that friction bends it by. Half
/// of what the law of a moving motor makes of it is open.
void begin_at_rest(Passage& t, const PassageContext& context, const ImpactTime& impact, const Reversal& r) {
  const double by_law = t.event.gap;
  t.event.t1 = t.t1_first = context.trace.time(r.last);
  t.event.x1_t1 = r.position;
  t.event.gap = t.event.gap_uncorrected = t.event.direction * (impact.position - r.position);
  t.half_width = std::max(t.half_width, 0.5 * std::abs(t.event.gap - by_law));
}

void read_release(Passage& t, const PassageContext& context, const FlightLaw& law, const ImpactTime& impact,
                  const Reversal& reversal) {
  const Release release = find_release(context, law, impact);
  if (!release.found) {
    refuse(t, Refusal::kNoRelease);
    return;
  }
  fill_event(t, context, impact, release);
  if (!release.far_flank) {
    if (!t.dwell || !rested(reversal, release)) {
      refuse(t, Refusal::kSameFlank);
      return;
    }
    begin_at_rest(t, context, impact, reversal);
  }
  const double open = std::max(std::abs(release.contradiction), release.passive ? 0.0 : release.load_travel);
  if (!(t.event.gap > 0.0) || open > kContradiction * t.event.gap)
    refuse(t, Refusal::kLoadMoving, t.event.gap > 0.0 ? open / t.event.gap : kNaN, kContradiction);
  const double along = way_along(t, release, reversal, context.facts.quantum + 2.0 * context.facts.noise);
  if (t.refusal == Refusal::kNone && along > kGoesAlong * t.event.gap)
    refuse(t, Refusal::kPushed, along / t.event.gap, kGoesAlong);
}

/// The largest gap that a passage can be: of a load that parted from the motor at any instant of the stroke
/// before, at the motor's speed, and kept that until the impact.
double most_of(const MotorTrace& trace, const Reversal& r, std::size_t from, const ImpactTime& impact) {
  const std::size_t span = std::max<std::size_t>(2, (r.last - from) / kSpeeds);
  double most = r.direction * (impact.position - trace.x1[r.last]);
  for (std::size_t i = from + span; i <= r.last; ++i) {
    const double parted = static_cast<double>(i) - 0.5 * static_cast<double>(span);
    const double speed = r.direction * (trace.x1[i - span] - trace.x1[i]) / static_cast<double>(span);
    const double place = 0.5 * (trace.x1[i - span] + trace.x1[i]);
    most = std::max(most, r.direction * (impact.position - place) + speed * (impact.time - parted));
  }
  return most;
}

/// Whether u steps where the impact is: what throws a motor that u does not drive on may be u itself.
bool steps(const PassageContext& context, const BankEvent& impact) {
  const auto& u = context.trace.u;
  const auto all = std::ranges::minmax(u);
  const std::size_t reach = 3 * impact.latency + 2, first = impact.start - std::min(impact.start, reach);
  const auto near =
      std::ranges::minmax(std::span(u).subspan(first, std::min(2 * reach + 1, u.size() - first)));
  return near.max - near.min > kStepOfInput * (all.max - all.min);
}

/// Where x1 stays at t1: at its turn, or behind it, where the motor came to rest once more.
Reversal stay_at(const PassageContext& context, const Reversal& turn, std::size_t t1) {
  const auto& y = context.trace.x1;
  const double tolerance = context.facts.quantum + 2.0 * context.facts.noise;
  Reversal stay = turn;
  const auto grow = [&](double place) {
    const auto alike = [&](std::size_t i) { return std::abs(y[i] - place) <= tolerance; };
    stay.first = stay.last = t1;
    while (stay.first > 0 && alike(stay.first - 1)) --stay.first;
    while (stay.last + 1 < y.size() && alike(stay.last + 1)) ++stay.last;
    stay.position = median(std::vector<double>(y.begin() + stay.first, y.begin() + stay.last + 1));
  };
  grow(y[t1]);
  grow(stay.position);  // of a single sample it is as far off as the noise
  stay.rise = turn.rise + turn.direction * (turn.position - stay.position);
  return stay;
}

/// The passage that began after sample `from`, but for how abrupt its end is.
Passage read_between(const PassageContext& context, const BankEvent& impact, std::size_t from) {
  Passage t;
  const auto& trace = context.trace;
  t.event.file = trace.file;
  t.event.direction = -impact.sign;  // contact with the far flank pushes the motor back
  t.event.t2 = trace.time(impact.start);
  t.event.x1_t2 = trace.x1[impact.start];
  const Reversal reversal = find_reversal(context, t.event.direction, from, impact.start);
  t.event.t1 = trace.time(reversal.last);
  t.event.x1_t1 = reversal.position;
  const bool small = reversal.rise < context.facts.least_way();
  if (small && !goes_on(context, t.event.direction, from, impact.start)) {
    refuse(t, Refusal::kSmallRise, reversal.rise / context.facts.least_way(), 1.0);
    return t;
  }
  const Flight flight = flight_of(context, impact, reversal);
  const FlightLaw& law = *flight.law;
  const ImpactTime& time = flight.impact;
  if (!time.found) {
    refuse(t, Refusal::kNoImpactFit);
    return t;
  }
  t.event.t2 = trace.start + trace.dt * time.time;
  t.event.x1_t2 = time.position;
  t.speed = t.event.direction * time.speed;
  t.acceleration = t.event.direction * time.acceleration;
  t.stiffness = time.stiffness;
  if (!small && !time.freed && (time.drive > 0.0 || !steps(context, impact)))
    t.most = most_of(trace, reversal, std::min(from, flight_begin(context, impact)), time);
  if (time.freed) {
    refuse(t, Refusal::kTorn);
    return t;
  }
  if (!(time.drive > 0.0)) {
    refuse(t, small ? Refusal::kNoReversal : Refusal::kLoadHits);
    return t;
  }
  read_release(t, context, law, time, reversal);
  if (t.refusal == Refusal::kNone && small) refuse(t, Refusal::kLoadMoving);  // unless its law is known
  if (t.refusal != Refusal::kNone) return t;
  if (!t.dwell) return t;
  const auto begin = static_cast<std::size_t>(std::max((t.t1_last - trace.start) / trace.dt, 0.0)) + 1;
  const auto t1 = static_cast<std::size_t>(std::lround((t.event.t1 - trace.start) / trace.dt));
  const RestBeforeFlight passage{stay_at(context, reversal, t1), begin, time.core};
  const bool again = passage.rest.last - passage.rest.first >= kRested;
  const double left = std::abs(t.event.x1_t1 - (again ? passage.rest : reversal).position);
  t.half_width += 0.5 * std::min(left, kOwnBending * t.event.gap);  // by contact or by its own friction
  const RestingPlace place = resting_place(trace, context.facts, {&passage, 1});
  t.untold = place != RestingPlace::kAtLoad;
  if (place == RestingPlace::kAlone) refuse(t, Refusal::kRestsAlone);
  return t;
}

/// Abruptness of the second half of [from, to): what the motion before the impact needs [rad/s²].
double bound_needed_before(const BankMarks& run, std::size_t from, std::size_t to) {
  const std::size_t middle = (from + to) / 2;
  for (std::size_t j = run.bounds.size(); j-- > 0;)
    for (std::size_t i = middle; i < to; ++i)
      if (run.is_loud(i, j)) return abruptness(run, j, run.highest_peak(middle, to));
  return 0.0;
}

/// Contact that was lost soon after an impact was lost in the rebound from it, with different speeds of motor
/// and load. (A mark of the release itself is far less abrupt than the impact that follows it.)
void refuse_thrown_off(const PassageContext& context, const BankEvent& before, const BankEvent& impact,
                       Passage& t) {
  const double since = (t.event.t1 - context.trace.time(before.start)) / (t.event.t2 - t.event.t1);
  if (since >= 0.0 && since < kRebound && kEcho * before.abruptness > impact.abruptness)
    refuse(t, Refusal::kThrownOff, since, kRebound);
}

}  // namespace

void refuse(Passage& t, Refusal refusal, double seen, double limit) {
  t.refusal = refusal, t.seen = seen, t.limit = limit;
}

GapEvent event_of(const Passage& p) {
  GapEvent event = p.event;
  event.std = p.half_width / kNormal95;
  if (!p.released()) event.t1 = event.x1_t1 = event.std = kNaN;  // where x1 turned tells no loss of contact
  event.accepted = p.refusal == Refusal::kNone;
  if (!event.accepted) event.remark = refusal_text(p.refusal, p.seen, p.limit);
  return event;
}

Passage read_passage(const PassageContext& context, const BankEvent& before, const BankEvent& impact,
                     double sliding) {
  const BankMarks& run = context.run;
  const std::size_t from = before.start, to = impact.start;
  Passage t = read_between(context, impact, from);
  const double needed = std::max(
      sliding,
      bound_needed_before(run, from, to - std::min(to - from, std::max<std::size_t>(2, impact.latency))));
  t.abruptness = impact.abruptness;
  t.contrast = impact.abruptness / needed;
  if (t.contrast < kContrast)
    refuse(t, Refusal::kContrast, t.contrast, kContrast), t.most = kNaN;
  else if (t.refusal == Refusal::kNone)
    refuse_thrown_off(context, before, impact, t);
  return t;
}

void see_later(Passage& t, const MotorTrace& trace, const BankEvent& later) {
  const double share = later.abruptness / t.abruptness;
  if (!(share > t.later)) return;
  t.later = share;
  t.to_later = std::abs(trace.x1[later.start] - t.event.x1_t1);
}

std::vector<Passage> read_passages(const PassageContext& context, std::span<const BankEvent> events,
                                   double sliding) {
  std::vector<Passage> passages;
  for (std::size_t i = 1; i < events.size(); ++i)
    if (events[i].sign != events[i - 1].sign)
      passages.push_back(read_passage(context, events[i - 1], events[i], sliding));
    else if (!passages.empty())
      see_later(passages.back(), context.trace, events[i]);
  read_coasting(context.trace, context.facts, passages);
  refuse_pushed_loads(context.trace, context.facts, passages);
  return passages;
}

}  // namespace gapscope::internal::sliding_mode
