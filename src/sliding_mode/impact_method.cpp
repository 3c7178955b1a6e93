#include "sliding_mode/impact_method.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "sliding_mode/visible_gap.h"

namespace gapscope::internal {
namespace {

constexpr double kContrast = 1.6;  ///< ρ

constexpr double kEcho = 2.5;  ///< an earlier impact that is this much weaker is none; a later one is an echo
constexpr double kRebound = 0.25;  ///< of the flight, from the impact before to its begin
constexpr std::size_t kSameSignSteps = 4;
constexpr double kMostTops =
    0.95;  ///< of the main events: what an impact at every reversal would stand out of

/// Recoil, ringing and overshoot follow an impact with the opposite sign, sometimes more abruptly than it;
/// what precedes an impact with the opposite sign (the motor speeding up in the gap) is far less abrupt.
bool dominates(const Event& strong, const Event& weak, const BankRun& run) {
  if (strong.sign == weak.sign) return strong.top >= weak.top + kSameSignSteps;
  const double ratio = run.bounds[strong.top] / run.bounds[weak.top];
  return strong.start <= weak.start ? ratio >= 1.0 / kEcho : ratio > kEcho;
}

/// Events that are as abrupt as one per half period should be, and not the echo of another. Ranked by the top
/// bound, never by Δv: for an acceleration step the latter is meaningless.
std::vector<Event> main_events(const std::vector<Event>& events, const ImpactAnalysis& a, double dt) {
  std::vector<Event> found;
  std::vector<double> tops;
  for (const Event& e : events)
    if (e.seen >= 3) tops.push_back(a.run.bounds[e.top]);
  if (tops.size() < kFewestHalfPeriods) return found;
  std::sort(tops.rbegin(), tops.rend());
  const double least = tops[std::min(a.facts.half_periods, tops.size()) - 1] / 6.0;
  const auto reach = static_cast<std::size_t>(0.2 * a.facts.half_period / dt);
  for (const Event& e : events) {
    if (e.seen < 3 || a.run.bounds[e.top] < least) continue;
    const bool echo = std::any_of(events.begin(), events.end(), [&](const Event& other) {
      const std::size_t distance = other.start > e.start ? other.start - e.start : e.start - other.start;
      return other.seen >= 3 && distance <= reach && dominates(other, e, a.run);
    });
    if (!echo) found.push_back(e);
  }
  return found;
}

/// Highest bound with any excursion in the second half of [from, to): what the motion before the impact
/// needs.
double bound_needed_before(const BankRun& run, std::size_t from, std::size_t to) {
  for (std::size_t j = run.bounds.size(); j-- > 0;)
    for (std::size_t i = (from + to) / 2; i < to; ++i)
      if (std::abs(run.error(i, j)) > 2.0 * run.floor[j]) return run.bounds[j];
  return 0.0;
}

/// Contact that was lost soon after an impact was lost in the rebound from it, with different speeds of motor
/// and load. (A mark of the release itself is far less abrupt than the impact that follows it.)
bool thrown_off(const MotorTrace& trace, const ImpactAnalysis& a, const Event& before, const Event& impact,
                const Transition& t) {
  const double since = t.event.t1 - trace.time(before.start);
  return since >= 0.0 && since < kRebound * (t.event.t2 - t.event.t1) &&
         kEcho * a.run.bounds[before.top] > a.run.bounds[impact.top];
}

void read_passages(const MotorTrace& trace, ImpactAnalysis& a) {
  const TransitionContext context{trace, a.facts, a.run};
  const double sliding = a.run.bounds[a.sliding];
  for (std::size_t i = 1; i < a.events.size(); ++i) {
    if (a.events[i].sign == a.events[i - 1].sign) continue;
    const std::size_t from = a.events[i - 1].start, to = a.events[i].start;
    Transition t = read_transition(context, a.events[i], from);
    const double needed = std::max(
        sliding, bound_needed_before(
                     a.run, from, to - std::min(to - from, std::max<std::size_t>(2, a.events[i].latency))));
    t.contrast = a.run.bounds[a.events[i].top] / needed;
    if (t.contrast < kContrast)
      t.refusal = Refusal::kContrast;
    else if (t.refusal == Refusal::kNone && thrown_off(trace, a, a.events[i - 1], a.events[i], t))
      t.refusal = Refusal::kThrownOff;
    a.passages.push_back(std::move(t));
  }
}

/// Index of the bound that so many of the main events do not exceed.
std::size_t top_bound(const ImpactAnalysis& a, double share) {
  std::vector<double> tops;
  for (const Event& e : a.events) tops.push_back(static_cast<double>(e.top));
  return tops.empty() ? a.sliding : static_cast<std::size_t>(quantile(std::move(tops), share));
}

void search(const MotorTrace& trace, ImpactAnalysis& a) {
  if (!a.facts.defect.empty()) return;
  a.run = run_bank(trace, a.facts, bound_grid(a.facts, trace.dt), Discretisation::kMatched);
  a.sliding = smallest_sliding(a.run);
  std::vector<std::vector<Excursion>> excursions;
  for (std::size_t j = 0; j < a.run.bounds.size(); ++j) excursions.push_back(find_excursions(a.run, j));
  const auto tolerance = static_cast<std::size_t>(std::max(4.0, 0.01 * a.facts.half_period / trace.dt));
  a.events = main_events(link_events(a.run, excursions, tolerance), a, trace.dt);
  a.deciding = top_bound(a, 0.5);
  const std::size_t above = top_bound(a, kMostTops) + 1;
  a.smallest_visible_gap =
      above < a.run.bounds.size() ? smallest_visible_gap(trace, a.facts, a.run, above) : kInfinity;
  a.finest_gap = smallest_visible_gap(trace, a.facts, a.run, a.sliding);
  read_passages(trace, a);
}

}  // namespace

ImpactAnalysis analyse(const MotorTrace& trace) {
  ImpactAnalysis a;
  a.facts = read_facts(trace);
  a.quantum = a.facts.quantum;
  search(trace, a);
  return a;
}

ImpactAnalysis analyse_mean(const FoldedMotion& mean, const MotorTrace& whole) {
  ImpactAnalysis a;
  const MotorTrace trace = mean.trace(whole.file);
  a.facts = read_facts(trace, mean.noise);
  a.facts.rounding = mean.rounding;
  a.quantum = mean.quantum;
  a.repeats = true;
  search(trace, a);
  return a;
}

}  // namespace gapscope::internal
