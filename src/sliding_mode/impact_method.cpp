#include "sliding_mode/impact_method.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "sliding_mode/coasting.h"
#include "sliding_mode/passages.h"
#include "sliding_mode/pooled_flights.h"
#include "sliding_mode/pushed_load.h"
#include "sliding_mode/visible_gap.h"

namespace gapscope::internal::sliding_mode {
namespace {

void read_passages(const MotorTrace& trace, const BankMarks& marks, const std::vector<BankEvent>& events,
                   ImpactAnalysis& a) {
  const TransitionContext context{trace, a.facts, marks};
  for (std::size_t i = 1; i < events.size(); ++i)
    if (events[i].sign != events[i - 1].sign)
      a.passages.push_back(read_passage(context, events[i - 1], events[i], a.run.bounds[a.sliding]));
}

/// Between one passage and the next, where the torque changes its sign more often than the motion passes its
/// centre [samples].
double stroke(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const double half_period = facts.half_period / trace.dt;
  std::vector<double> turns;
  for (const TorqueTurn& turn : torque_turns(trace))
    turns.push_back(static_cast<double>(turn.next - turn.zero));
  return turns.empty() ? half_period : std::min(half_period, median(std::move(turns)));
}

void search(const MotorTrace& trace, ImpactAnalysis& a) {
  if (!a.facts.defect.empty()) return;
  const BankMarks marks = mark_bank(trace, a.facts, bound_grid(a.facts, trace.dt));
  a.run = marks;  // but for the marks, of which there are as many as samples
  a.sliding = smallest_sliding(a.run);
  const double half_period = stroke(trace, a.facts);
  const std::vector<BankEvent> all = all_events(marks, half_period);
  std::vector<BankEvent> events;
  if (const auto least = least_top(all, a.run, a.facts.half_periods))
    events = main_events(all, a.run, *least, half_period);
  a.marks = events.size();
  std::vector<std::size_t> tops(a.run.bounds.size());
  for (const BankEvent& e : events) ++tops[e.top];
  a.deciding = top_bound(tops, kMiddle, a.sliding);
  const std::size_t above = top_bound(tops, kMostTops, a.sliding) + 1;
  a.smallest_visible_gap =
      above < a.run.bounds.size() ? smallest_visible_gap(trace, a.facts, a.run, above) : kInfinity;
  a.finest_gap = smallest_visible_gap(trace, a.facts, a.run, a.sliding);
  read_passages(trace, marks, events, a);
  read_coasting(trace, a.facts, a.repeats, a.passages);
  refuse_pushed_loads(trace, a.facts, a.passages);
}

}  // namespace

ImpactAnalysis analyse(const MotorTrace& trace, const signals::SignalFacts& facts) {
  ImpactAnalysis a;
  a.facts = facts;
  a.quantum = a.facts.quantum;
  search(trace, a);
  a.one_body_gap = [trace, facts] { return one_body_visible_gap(trace, facts); };
  return a;
}

double one_body_gap(std::span<const ImpactAnalysis> analyses) {
  double gap = 0.0;
  for (const ImpactAnalysis& a : analyses)
    if (a.facts.defect.empty() && gap < kInfinity) gap = std::max(gap, a.one_body_gap());
  return gap;
}

ImpactAnalysis analyse_mean(const signals::FoldedMotion& mean, const MotorTrace& whole) {
  ImpactAnalysis a;
  const MotorTrace trace = mean.trace(whole.file);
  a.facts = signals::read_facts(trace, mean.noise);
  a.facts.rounding = mean.rounding;
  a.quantum = mean.quantum;
  a.repeats = true;
  search(trace, a);
  return a;
}

}  // namespace gapscope::internal::sliding_mode
