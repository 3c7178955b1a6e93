#include "diagnosis/open_question.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

/// The best candidate of a step and the next one that the data hardly tells from it; none where it is clear.
/// What contains the best is no rival: parsimony has decided; nor is what explains far less.
std::vector<Rival> rivals_of(const std::vector<ScoredModel>& candidates, const ScoredModel& before,
                             const Decision& decision) {
  if (decision.accepted && decision.group.size() < 2 && decision.margin >= kRule.clear) return {};
  std::vector<Rival> rivals;
  for (const ScoredModel& c : candidates) {
    if (rivals.size() == 2 || !std::isfinite(c.score)) break;
    if (before.score - c.score < std::max(kRule.indistinct, kTelling.rival_share * decision.gain)) break;
    const bool contains_best = contained_effect(*c.entry) == candidates.front().entry;
    if (reads_counts(*c.entry) || contains_best) continue;
    rivals.push_back({c.entry->name, c.fitted.model});
    rivals.back().model.controller.reset();  // the next experiment gives an input
  }
  if (rivals.size() < 2) rivals.clear();
  return rivals;
}

}  // namespace

std::vector<Rival> open_question(const FirstSearch& found, const Additions& added) {
  std::vector<Rival> rivals;
  if (!(added.accepted && !found.decision.accepted))  // else a later step has decided it
    rivals = rivals_of(found.candidates, found.before, found.decision);
  for (const FurtherStep& step : added.steps)
    if (rivals.empty() && added.accepted && step.decision.accepted)
      rivals = rivals_of(step.candidates, step.before, step.decision);
  return rivals;
}

}  // namespace gapscope::internal::diagnosis
