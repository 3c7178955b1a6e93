#include "sliding_mode/paper_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal {
namespace {

/// S2: a stretch of rest that long, as a share of the half period, is an interval in which e_x has converged.
constexpr double kQuietShare = 0.02;
/// S4: the fall from the peak through zero takes at most this share of the ramp before it.
constexpr double kAbruptShare = 0.5;
/// t1 further from the reversal of x1 than this share of the passage: the divergence was seen too late.
constexpr double kLatest = 0.15;

/// The extremum that x1 leaves in this direction, within the last half period before t2.
std::size_t reversal_before(const MotorTrace& trace, const SignalFacts& facts, int direction,
                            std::size_t to) {
  const auto reach = static_cast<std::size_t>(0.7 * facts.half_period / trace.dt);
  const std::size_t from = to > reach ? to - reach : 0;
  std::size_t at = to;
  for (std::size_t i = to + 1; i-- > from;)
    if (direction * trace.x1[i] < direction * trace.x1[at]) at = i;
  return at;
}

/// The last sample before the peak at which e_x still rises nearly as fast as it ever did: the impact lies
/// between.
std::size_t steepest_before(const BankRun& run, const Excursion& ramp) {
  const auto rise = [&](std::size_t i) { return ramp.sign * (run.error(i, 0) - run.error(i - 1, 0)); };
  double steepest = 0.0;
  for (std::size_t i = ramp.start + 1; i <= ramp.peak; ++i) steepest = std::max(steepest, rise(i));
  std::size_t at = ramp.peak;
  while (at > ramp.start + 1 && rise(at) < 0.7 * steepest) --at;
  return at;
}

struct Pair {
  const Excursion& ramp;
  const Excursion& flip;
  std::size_t quiet_from;
};

GapEvent event_of(const MotorTrace& trace, const Pair& pair) {
  GapEvent event;
  event.file = trace.file;
  event.t1 = trace.time(pair.ramp.start);
  event.t2 = trace.time(pair.ramp.peak);
  event.x1_t1 = trace.x1[pair.ramp.start];
  event.x1_t2 = trace.x1[pair.ramp.peak];
  event.direction = pair.ramp.sign;  // in the gap the motor runs ahead of its estimate
  event.gap = event.gap_uncorrected = std::abs(event.x1_t2 - event.x1_t1);
  return event;
}

/// Empty, or why this ramp and flip are no passage.
std::string fault(const MotorTrace& trace, const SignalFacts& facts, const Pair& pair, double quiet_samples) {
  const double ramp = static_cast<double>(pair.ramp.peak - pair.ramp.start);
  const double fall = static_cast<double>(pair.flip.start - pair.ramp.peak);
  if (static_cast<double>(pair.ramp.start - pair.quiet_from) < quiet_samples)
    return "e_x was not at rest before t1";
  if (fall > kAbruptShare * ramp) return "e_x does not reverse abruptly";
  const double covered = pair.ramp.sign * (trace.x1[pair.ramp.peak] - trace.x1[pair.ramp.start]);
  if (covered < 8.0 * facts.noise + 2.0 * facts.quantum)
    return "x1 does not move along the gap from t1 to t2";
  return "";
}

}  // namespace

PaperReading read_with_bound(const MotorTrace& trace, const ImpactAnalysis& analysis, double bound) {
  PaperReading reading;
  reading.bound = bound;
  const SignalFacts& facts = analysis.facts;
  if (!facts.defect.empty()) return reading;
  const BankRun run = run_bank(trace, facts, {bound}, Discretisation::kForwardEuler);
  reading.quiet = run.quiet[0];
  const auto excursions = find_excursions(run, 0);
  const double quiet_samples = std::max(3.0, kQuietShare * facts.half_period / trace.dt);
  for (std::size_t i = 1; i + 1 < excursions.size(); ++i) {
    const Pair pair{excursions[i], excursions[i + 1], excursions[i - 1].end};
    const bool flips = pair.flip.sign != pair.ramp.sign && pair.flip.start <= pair.ramp.end + 2;
    if (!flips) {
      ++reading.spikes;
      continue;
    }
    GapEvent event = event_of(trace, pair);
    event.remark = fault(trace, facts, pair, quiet_samples);
    event.accepted = event.remark.empty();
    if (event.accepted) {
      const std::size_t turn = reversal_before(trace, facts, event.direction, pair.ramp.peak);
      reading.lateness.push_back(std::abs(event.x1_t1 - trace.x1[turn]));
      reading.steps.push_back(0.5 *
                              std::abs(trace.x1[steepest_before(run, pair.ramp)] - trace.x1[pair.ramp.peak]));
      event.std = 0.5 * reading.lateness.back();
    }
    reading.events.push_back(std::move(event));
  }
  return reading;
}

namespace {

std::string objection(const std::vector<double>& up, const std::vector<double>& down, double quiet,
                      double half_periods, double lateness, double travel) {
  if (quiet < 0.2) return "e_x is never at rest: the bound is below the engaged acceleration";
  const double n = static_cast<double>(up.size() + down.size());
  if (up.size() < 2 || down.size() < 2 || n < 0.5 * half_periods)
    return "no t1: the bound is above the gap-mode acceleration, only the impact shows";
  const double gap = 0.5 * (median(up) + median(down));
  if (lateness > kLatest * gap)
    return fmt::format(
        "t1 comes {:.0f} % of the passage late: the bound is close to the gap-mode acceleration",
        100.0 * lateness / gap);
  if (gap > 0.66 * travel)
    return fmt::format("the estimate of {:.3g} rad is most of the travel of {:.3g} rad; raise the amplitude",
                       gap, travel);
  const double spread = std::max(robust_std(up), robust_std(down));
  if (spread > 0.25 * gap || std::abs(median(up) - median(down)) > 0.25 * gap)
    return "the passages contradict each other; record more periods of one steady motion";
  return "";
}

/// All readings together.
struct Pool {
  std::vector<double> up, down, lateness, steps;
  double quiet = 1.0, half_periods = 0.0, travel = kInfinity, noise = 0.0;
};

void add(Pool& pool, const ImpactAnalysis& analysis, const PaperReading& reading) {
  for (const GapEvent& event : reading.events)
    if (event.accepted) (event.direction > 0 ? pool.up : pool.down).push_back(event.gap);
  pool.lateness.insert(pool.lateness.end(), reading.lateness.begin(), reading.lateness.end());
  pool.steps.insert(pool.steps.end(), reading.steps.begin(), reading.steps.end());
  pool.quiet = std::min(pool.quiet, reading.quiet);
  pool.half_periods += static_cast<double>(analysis.facts.half_periods);
  pool.travel = std::min(pool.travel, analysis.travel);
  pool.noise = std::max(pool.noise, analysis.facts.noise);
}

void fill_estimate(const Pool& pool, GapEstimate& estimate) {
  const double up = median(pool.up), down = median(pool.down), late = median(pool.lateness);
  const double n = static_cast<double>(pool.up.size() + pool.down.size());
  const double scatter = std::max(robust_std(pool.up), robust_std(pool.down)) / std::sqrt(0.5 * n);
  const double difference = 0.5 * (up - down);
  const double latency = median(pool.steps);
  estimate.verdict = GapVerdict::kBacklash;
  estimate.gap = 0.5 * (up + down);
  estimate.std = std::sqrt(scatter * scatter + difference * difference + 0.25 * late * late +
                           latency * latency + 2.0 * pool.noise * pool.noise);
  estimate.ci95 = {std::max(estimate.gap - 1.96 * estimate.std, 0.0), estimate.gap + 1.96 * estimate.std};
  estimate.reason =
      fmt::format("{:.0f} of {:.0f} reversals read with L = {:.3g}", n, pool.half_periods, estimate.bound);
}

}  // namespace

void decide_with_bound(std::span<const ImpactAnalysis> analyses, std::span<const PaperReading> readings,
                       GapEstimate& estimate) {
  estimate.method = GapMethod::kPaper;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.reason = "no recording";
  Pool pool;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!analyses[i].facts.defect.empty()) {
      estimate.reason = analyses[i].facts.defect;
      continue;
    }
    estimate.bound = readings[i].bound;
    estimate.events.insert(estimate.events.end(), readings[i].events.begin(), readings[i].events.end());
    add(pool, analyses[i], readings[i]);
  }
  if (pool.half_periods == 0.0) return;
  estimate.reason =
      objection(pool.up, pool.down, pool.quiet, pool.half_periods, median(pool.lateness), pool.travel);
  if (estimate.reason.empty()) fill_estimate(pool, estimate);
}

}  // namespace gapscope::internal
