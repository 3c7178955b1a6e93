#include "sliding_mode/published/paper_method.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "sliding_mode/published/bend.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// S2: a stretch of rest that long, as a share of the half period, is an interval in which e_x has converged.
constexpr double kQuietShare = 0.02;
/// S2: e_x is at rest, on its own scale, below this share of what it reaches in every half period.
constexpr double kRestShare = 0.1;
/// S4: the fall from the peak through zero takes at most this share of the ramp before it.
constexpr double kAbruptShare = 0.5;
/// t1 further from the reversal of x1 than this share of the passage: the divergence was seen too late.
constexpr double kLatest = 0.15;

/// The extremum that x1 leaves in this direction, within the last half period before t2.
std::size_t reversal_before(const MotorTrace& trace, const signals::SignalFacts& facts, int direction,
                            std::size_t to) {
  const auto reach = static_cast<std::size_t>(0.7 * facts.half_period / trace.dt);
  const std::size_t from = to > reach ? to - reach : 0;
  std::size_t at = to;
  for (std::size_t i = to + 1; i-- > from;)
    if (direction * trace.x1[i] < direction * trace.x1[at]) at = i;
  return at;
}

/// What one excursion of e_x shows: t1 and t2 in samples, or why it is no passage.
struct RampMarks {
  double t1 = 0.0, t2 = 0.0;
  std::string fault;
  bool restless = false;  ///< e_x was away from zero since before the reversal of x1, and shows no bend
};

double at(std::span<const double> y, double sample) {
  const auto i = std::min(static_cast<std::size_t>(sample), y.size() - 2);
  return std::lerp(y[i], y[i + 1], sample - static_cast<double>(i));
}

/// Soon enough for one reversal of e_x: bounces may hold it near zero for a while.
bool follows(const Excursion& ramp, const Excursion& next) {
  const double pause = static_cast<double>(next.start) - static_cast<double>(ramp.end);
  return pause <= std::max(2.0, 0.1 * static_cast<double>(ramp.peak - ramp.start));
}

/// First sample after the peak at which e_x has lost this share of its height.
std::size_t fallen(const BankErrors& run, const Excursion& x, double share) {
  std::size_t i = x.peak;
  while (i < x.end && x.sign * run.error(i, 0) > (1.0 - share) * x.height) ++i;
  return i;
}

/// One ramp of e_x. At rest before it (S2): t1 is the last sample at rest, and e_x flips its sign at the
/// impact. Away from zero since before the reversal of x1: t1 is where it bends away, and it loses half its
/// height.
RampMarks read_ramp(const MotorTrace& trace, const signals::SignalFacts& facts, const BankErrors& run,
                    const Excursion& ramp, std::size_t quiet_from, bool flips) {
  RampMarks marks{static_cast<double>(ramp.start), 0.0, "", false};
  const double quiet_samples = std::max(3.0, kQuietShare * facts.half_period / trace.dt);
  std::size_t down = fallen(run, ramp, 1.0);
  if (!flips || static_cast<double>(ramp.start - quiet_from) < quiet_samples) {
    const std::size_t turn = reversal_before(trace, facts, ramp.sign, ramp.peak);
    const auto bend = bend_at_release(run, ramp, turn);
    if (!bend) marks.fault = "e_x was not at rest before t1";
    marks.restless = !bend && turn > ramp.start;
    marks.t1 = bend.value_or(marks.t1);
    down = fallen(run, ramp, 0.5);
  }
  marks.t2 = static_cast<double>(ramp.peak);
  if (marks.fault.empty() && static_cast<double>(down) - marks.t2 > kAbruptShare * (marks.t2 - marks.t1))
    marks.fault = "e_x does not reverse abruptly";
  if (marks.fault.empty()) marks.t2 = bend_before_peak(run, ramp, marks.t1);
  const double covered = ramp.sign * (at(trace.x1, marks.t2) - at(trace.x1, marks.t1));
  if (marks.fault.empty() && covered < facts.least_way())
    marks.fault = "x1 does not move along the gap from t1 to t2";
  return marks;
}

/// Which way x1 goes just before a sample; the other one where it stands still.
int way_before(const MotorTrace& trace, const signals::SignalFacts& facts, double sample, int otherwise) {
  const auto to = static_cast<std::size_t>(sample);
  const auto reach =
      static_cast<std::size_t>(std::max(3.0, 0.5 * kQuietShare * facts.half_period / trace.dt));
  const double way = trace.x1[to] - trace.x1[to - std::min(to, reach)];
  return std::abs(way) <= facts.quantum ? otherwise : way > 0.0 ? 1 : -1;
}

/// Of a faulty reading t2 alone is told.
/// @param direction  in the gap the motor runs ahead of its estimate; where that is not so, as it goes
GapEvent event_of(const MotorTrace& trace, const RampMarks& marks, int direction) {
  GapEvent event;
  event.file = trace.file;
  event.t2 = trace.start + trace.dt * marks.t2;
  event.x1_t2 = at(trace.x1, marks.t2);
  event.direction = direction;
  event.remark = marks.fault;
  event.accepted = event.remark.empty();
  if (!event.accepted) return event;
  event.t1 = trace.start + trace.dt * marks.t1;
  event.x1_t1 = at(trace.x1, marks.t1);
  event.gap = event.gap_uncorrected = std::abs(event.x1_t2 - event.x1_t1);
  return event;
}

constexpr const char* kNoBegin = "no t1: e_x was at rest until then";

/// An impact that stops the motor throws e_x back from rest, against the motion: what preceded it did not
/// show.
bool only_impact(const MotorTrace& trace, const signals::SignalFacts& facts, const Excursion& x,
                 std::size_t quiet_from) {
  const double rest = static_cast<double>(x.start) - static_cast<double>(quiet_from);
  return rest * trace.dt >= kQuietShare * facts.half_period &&
         x.sign == -way_before(trace, facts, static_cast<double>(x.start), x.sign);
}

/// The excursions that count on the scale of e_x (S2): lower ones than a share of what each half period
/// reaches are rest.
std::vector<Excursion> excursions_on_scale(const BankErrors& run, std::size_t half_periods) {
  std::vector<Excursion> all = find_excursions(run, 0);
  std::vector<double> heights;
  for (const Excursion& x : all) heights.push_back(x.height);
  std::sort(heights.rbegin(), heights.rend());
  const double least = heights.size() < half_periods ? 0.0 : kRestShare * heights[half_periods - 1];
  std::erase_if(all, [least](const Excursion& x) { return x.height < least; });
  return all;
}

}  // namespace

PaperReading read_with_bound(const MotorTrace& trace, const signals::SignalFacts& facts, double bound,
                             Discretisation discretisation) {
  PaperReading reading;
  reading.bound = bound;
  if (!facts.defect.empty()) return reading;
  const BankErrors run = run_bank(trace, facts, {bound}, discretisation);
  reading.quiet = run.quiet[0];
  const auto excursions = excursions_on_scale(run, facts.half_periods);
  for (std::size_t i = 1; i + 1 < excursions.size(); ++i) {
    const Excursion &ramp = excursions[i], &next = excursions[i + 1];
    const bool flips = next.sign != ramp.sign && follows(ramp, next);
    RampMarks marks = read_ramp(trace, facts, run, ramp, excursions[i - 1].end, flips);
    reading.restless += marks.restless;
    const bool impact = !marks.fault.empty() && only_impact(trace, facts, ramp, excursions[i - 1].end);
    if (impact) marks.t2 = static_cast<double>(ramp.start), marks.fault = kNoBegin;
    if (!flips && !impact && !marks.fault.empty()) continue;  // a spike
    const int way = marks.fault.empty() ? ramp.sign : way_before(trace, facts, marks.t2, ramp.sign);
    GapEvent event = event_of(trace, marks, way);
    if (event.accepted) {
      const std::size_t turn = reversal_before(trace, facts, event.direction, ramp.peak);
      const auto i2 = static_cast<std::size_t>(marks.t2);
      reading.lateness.push_back(std::abs(event.x1_t1 - trace.x1[turn]));
      reading.steps.push_back(0.5 * std::abs(trace.x1[i2 + 1] - trace.x1[i2]));
      event.std = 0.5 * reading.lateness.back();
    }
    reading.events.push_back(std::move(event));
  }
  // Below the accelerations of the gap a motor that brakes throws e_x back, too.
  if (2 * reading.lateness.size() >= facts.half_periods)
    std::erase_if(reading.events, [](const GapEvent& e) { return e.remark == kNoBegin; });
  return reading;
}

namespace {

/// All readings together.
struct PaperPool {
  std::vector<double> up, down, lateness, steps;
  double quiet = 1.0, half_periods = 0.0, travel = kInfinity, noise = 0.0, restless = 0.0;
  double reversals = 0.0;  ///< one more than half periods where the recording begins and ends in a passage
};

Remark paper_objection(const PaperPool& pool) {
  const auto &up = pool.up, &down = pool.down;
  if (pool.quiet < 0.2) return words::error_never_at_rest();
  const double n = static_cast<double>(up.size() + down.size());
  if (up.size() < 2 || down.size() < 2 || n < 0.5 * pool.half_periods)
    return pool.restless < 0.5 * pool.half_periods ? words::bound_above_gap_mode()
                                                   : words::bound_below_engaged();
  const double gap = 0.5 * (median(up) + median(down)), lateness = median(pool.lateness);
  if (lateness > kLatest * gap) return words::flank_late(100.0 * lateness / gap);
  if (gap > 0.66 * pool.travel) return words::most_of_travel(gap, pool.travel);
  const double spread = std::max(robust_std(up), robust_std(down));
  if (spread > 0.25 * gap || std::abs(median(up) - median(down)) > 0.25 * gap)
    return words::passages_contradict();
  return {};
}

void add_reading(PaperPool& pool, const signals::SignalFacts& facts, const PaperReading& reading) {
  const auto half_periods = static_cast<double>(facts.half_periods);
  const auto read = static_cast<double>(std::ranges::count_if(reading.events, &GapEvent::accepted));
  pool.reversals += std::max(half_periods, read);
  for (const GapEvent& event : reading.events)
    if (event.accepted) (event.direction > 0 ? pool.up : pool.down).push_back(event.gap);
  pool.lateness.insert(pool.lateness.end(), reading.lateness.begin(), reading.lateness.end());
  pool.steps.insert(pool.steps.end(), reading.steps.begin(), reading.steps.end());
  pool.quiet = std::min(pool.quiet, reading.quiet);
  pool.restless += static_cast<double>(reading.restless);
  pool.half_periods += half_periods;
  pool.travel = std::min(pool.travel, facts.travel);
  pool.noise = std::max(pool.noise, facts.noise);
}

void fill_paper_estimate(const PaperPool& pool, GapEstimate& estimate) {
  const double up = median(pool.up), down = median(pool.down), late = median(pool.lateness);
  const double n = static_cast<double>(pool.up.size() + pool.down.size());
  const double scatter = std::max(robust_std(pool.up), robust_std(pool.down)) / std::sqrt(0.5 * n);
  const double difference = 0.5 * (up - down);
  const double latency = median(pool.steps);
  estimate.verdict = GapVerdict::kBacklash;
  estimate.gap = 0.5 * (up + down);
  estimate.std = std::sqrt(scatter * scatter + difference * difference + 0.25 * late * late +
                           latency * latency + 2.0 * pool.noise * pool.noise);
  estimate.ci95 = {std::max(estimate.gap - kNormal95 * estimate.std, 0.0),
                   estimate.gap + kNormal95 * estimate.std};
  estimate.reason = words::reversals_read(n, pool.reversals, estimate.bound);
}

}  // namespace

GapEstimate decide_with_bound(std::span<const signals::SignalFacts> facts,
                              std::span<const PaperReading> readings) {
  GapEstimate estimate;
  estimate.method = GapMethod::kPaper;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.reason = words::no_recording();
  PaperPool pool;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!facts[i].defect.empty()) {
      estimate.reason = facts[i].defect;
      continue;
    }
    estimate.bound = readings[i].bound;
    estimate.events.insert(estimate.events.end(), readings[i].events.begin(), readings[i].events.end());
    add_reading(pool, facts[i], readings[i]);
  }
  if (pool.half_periods == 0.0) return estimate;
  estimate.reason = paper_objection(pool);
  if (estimate.reason.empty()) fill_paper_estimate(pool, estimate);
  return estimate;
}

}  // namespace gapscope::internal::sliding_mode
