#include "sliding_mode/marks/marks.h"

#include <algorithm>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Between one passage and the next, where the torque changes its sign more often than the motion passes its
/// centre [samples].
double stroke(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const double half_period = facts.half_period / trace.dt;
  std::vector<double> turns;
  for (const TorqueTurn& turn : torque_turns(trace))
    turns.push_back(static_cast<double>(turn.next - turn.zero));
  return turns.empty() ? half_period : std::min(half_period, median(std::move(turns)));
}

}  // namespace

Marks find_marks(const MotorTrace& trace, const signals::SignalFacts& facts) {
  Marks m;
  m.bank = mark_bank(trace, facts, bound_grid(facts, trace.dt));
  m.sliding = smallest_sliding(m.bank);
  const double half_period = stroke(trace, facts);
  const std::vector<BankEvent> all = all_events(m.bank, half_period);
  if (const auto least = least_top(all, m.bank, facts.half_periods))
    m.events = main_events(all, m.bank, *least, half_period);
  std::vector<std::size_t> tops(m.bank.bounds.size());
  for (const BankEvent& e : m.events) ++tops[e.top];
  m.deciding = top_bound(tops, kMiddle, m.sliding);
  m.hiding = top_bound(tops, kMostTops, m.sliding) + 1;
  return m;
}

}  // namespace gapscope::internal::sliding_mode
