#include "sliding_mode/impact_search.h"

#include "sliding_mode/marks/marks.h"
#include "sliding_mode/visible_gap.h"

namespace gapscope::internal::sliding_mode {

ImpactAnalysis analyse(const MotorTrace& trace, const signals::SignalFacts& facts) {
  ImpactAnalysis a;
  a.facts = facts;
  if (!facts.defect.empty()) return a;
  const Marks marks = find_marks(trace, facts);
  a.run = marks.bank;  // but for the marks, of which there are as many as samples
  a.sliding = marks.sliding;
  a.deciding = marks.deciding;
  a.marks = marks.events.size();
  const bool hidden = marks.hiding >= a.run.bounds.size();
  a.smallest_visible_gap = hidden ? kInfinity : smallest_visible_gap(trace, facts, a.run, marks.hiding);
  a.finest_gap = smallest_visible_gap(trace, facts, a.run, a.sliding);
  a.passages = read_passages({trace, facts, marks.bank}, marks.events, a.run.bounds[a.sliding]);
  return a;
}

}  // namespace gapscope::internal::sliding_mode
