#include "diagnosis/evidence.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/mismatch_size.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

ModelEvidence evidence_of(const ScoredModel& model, const ScoredModel& before) {
  return {model.entry != nullptr ? model.entry->name : "",
          model.score,
          model.fitted.mean_cost,
          model.median_free,
          model.median_innovation,
          share_of_windows_better(before, model)};
}

ScoredModel judged_by(const ModelEvidence& e) {
  ScoredModel j;
  j.entry = e.effect.empty() ? nullptr : find_effect(e.effect);
  j.fitted.mean_cost = e.mean_cost;
  j.score = e.score;
  j.median_free = e.median_free, j.median_innovation = e.median_innovation;
  j.windows_better = e.windows_better;
  return j;
}

}  // namespace

StepEvidence evidence_of(const Study& study, const FirstSearch& found) {
  StepEvidence e;
  e.nominal = evidence_of(found.before, found.before);
  e.alone = found.alone;
  e.repeats_badly = study.repeats_badly();
  for (const ScoredModel& c : found.candidates) e.candidates.push_back(evidence_of(c, found.before));
  for (const ScoredModel& c : found.excluded_parents)
    e.excluded_parents.push_back(evidence_of(c, found.before));
  return e;
}

}  // namespace internal::diagnosis

double StepEvidence::before() const {
  return std::isfinite(alone) ? alone : std::max(nominal.median_free, nominal.median_innovation);
}

StepOutcome decide_again(const StepEvidence& evidence, const std::vector<std::string>& excluded) {
  using namespace internal::diagnosis;
  const ScoredModel before = judged_by(evidence.nominal);
  std::vector<ScoredModel> candidates, parents;
  for (const ModelEvidence& e : evidence.candidates)
    (contains(excluded, e.effect) ? parents : candidates).push_back(judged_by(e));
  for (const ModelEvidence& e : evidence.excluded_parents) parents.push_back(judged_by(e));
  rank(candidates);
  const Decision decision =
      decide_alone(candidates, before, evidence.repeats_badly ? Reach::kAnyGain : Reach::kFloor, parents);
  StepOutcome out;
  for (const ScoredModel& c : candidates) out.ranking.push_back(c.entry->name);
  for (const EffectEntry* entry : decision.group) out.group.push_back(entry->name);
  out.accepted = decision.accepted;
  out.rel = decision.rel, out.margin = decision.margin, out.gain = decision.gain;
  out.probability = decision.probability;
  if (!candidates.empty()) out.shrink = shrink_of(before.median_free, candidates.front().median_free);
  return out;
}

}  // namespace gapscope
