#include "diagnosis/further.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/interrupt.h"
#include "diagnosis/candidates.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/probability.h"
#include "diagnosis/step.h"

namespace gapscope::internal::diagnosis {
namespace {

/// The model so far as the one to add to. An effect that others contain comes last: they take its place.
ScoredModel base_of(const ScoredModel& model) {
  ScoredModel base = model;
  base.entry = nullptr;
  base.score = log_score(model.windows);
  std::stable_partition(
      base.fitted.model.effects.begin(), base.fitted.model.effects.end(), [](const ModelEffect& e) {
        const auto table = effect_table();
        return std::none_of(table.begin(), table.end(),
                            [&](const EffectEntry* child) { return contained_effect(*child) == e.entry; });
      });
  return base;
}

bool worth_following(const ScoredModel& before, const ScoredModel& after) {
  return before.score - after.score >= kRule.tells_apart &&
         share_of_windows_better(before, after) >= kRule.least_windows;
}

FurtherStep next_step(const Study& study, const ScoredModel& model) {
  FurtherStep step{base_of(model), {}, {}, {}};
  std::vector<const EffectEntry*> catalogue = study.catalogue;
  std::erase_if(catalogue, [&](const EffectEntry* e) { return has_effect(model.fitted.model, e); });
  step.candidates = candidates_of(study, step.before, catalogue, false);
  // An earlier effect's law may be another than the drive's and keep every later step off the floor.
  Decision& d = step.decision = decide(step.candidates, step.before, Reach::kAnyGain, {});
  if (!study.repeats_badly() && !step.candidates.empty())
    d.probability = later_probability(d.rel, d.margin, d.gain);
  return step;
}

ReferenceModel without(ReferenceModel model, const EffectEntry* entry) {
  std::erase_if(model.effects, [&](const ModelEffect& e) { return e.entry == entry; });
  return model;
}

/// An effect's place taken by the simpler one that it contains, whose parameters are its first ones.
ReferenceModel with_simpler(ReferenceModel model, const EffectEntry& entry, const EffectEntry& simpler) {
  for (ModelEffect& e : model.effects) {
    if (e.entry != &entry) continue;
    e.entry = &simpler;
    std::fill(e.parameters.begin() + static_cast<std::ptrdiff_t>(simpler.parameters.size()),
              e.parameters.end(), ParameterSetting());
  }
  return model;
}

ScoredModel refitted(const Study& study, const ReferenceModel& model) {
  return judge(nullptr, fit_near(study.train, model, study.options.fit, study.observer_hz), study.held_out,
               study.observer_hz);
}

/// Takes out what the last effect has made superfluous.
void drop_stand_ins(const Study& study, Additions& a) {
  const EffectEntry* last = a.effects.back().entry;
  const auto superfluous = [&](const Addition& effect) {
    if (effect.entry == last || !has_effect(a.after.fitted.model, effect.entry)) return false;
    const ScoredModel less = refitted(study, without(a.after.fitted.model, effect.entry));
    if (!(less.score < log_score(a.after.windows) + kRule.indistinct)) return false;
    a.after = less;
    a.steps.back().dropped.push_back(effect.entry);
    return true;
  };
  std::erase_if(a.effects, superfluous);
}

/// Where an effect was chosen while later ones were still missing, one of its look-alikes may now be better.
void choose_among_look_alikes(const Study& study, Additions& a) {
  for (Addition& effect : a.effects) {
    if (at_floor(a.after) || study.is_exhausted()) return;
    if (effect.entry == a.effects.back().entry || !has_effect(a.after.fitted.model, effect.entry)) continue;
    std::vector<const EffectEntry*> alike{effect.entry};
    for (const EffectEntry* e : study.catalogue)
      if (look_alike(*e, *effect.entry) && !has_effect(a.after.fitted.model, e)) alike.push_back(e);
    const ScoredModel less = refitted(study, without(a.after.fitted.model, effect.entry));
    std::vector<ScoredModel> ranked = candidates_of(study, base_of(less), alike, false);
    if (ranked.empty() || ranked.front().entry == effect.entry) continue;
    if (!(ranked.front().score < log_score(a.after.windows) - kRule.indistinct)) continue;
    a.steps.back().dropped.push_back(effect.entry);
    effect = {ranked.front().entry, {ranked.front().entry}};
    a.after = std::move(ranked.front());
  }
}

/// Where an effect was chosen while later ones were still missing, the simpler one within it may do as well
/// now: what it has more stood for them.
void take_simpler(const Study& study, Additions& a) {
  for (Addition& effect : a.effects) {
    const EffectEntry* const simpler = contained_effect(*effect.entry);
    if (simpler == nullptr || effect.entry == a.effects.back().entry || finish_requested() ||
        !has_effect(a.after.fitted.model, effect.entry) || has_effect(a.after.fitted.model, simpler))
      continue;
    const ScoredModel less = refitted(study, with_simpler(a.after.fitted.model, *effect.entry, *simpler));
    if (!(less.score < log_score(a.after.windows) + kRule.indistinct)) continue;
    a.steps.back().dropped.push_back(effect.entry);
    effect = {simpler, {simpler}};
    a.after = less;
  }
}

/// Whether one set of numbers leaves nothing to explain, though those of the fitted recordings alone leave
/// something on the others: these asked for what the fitted ones do not determine.
bool explained_without(const Study& study, const ScoredModel& model) {
  if (study.repeats_badly() || !(model.fitted.mean_cost < kExplained)) return false;
  const ScoredModel together =
      judge(nullptr, fit_near(everything(study), model.fitted.model, study.options.fit, study.observer_hz),
            study.held_out, study.observer_hz);
  return at_floor(together) && together.fitted.mean_cost < kExplained;
}

/// Whether the fitted recordings leave nothing to ask, or far less than those held out.
bool asks_elsewhere(const Study& study, const ScoredModel& model) {
  const double fitted = model.fitted.mean_cost;
  return may_fit_half_of_the_held_out(study) &&
         (fitted < kRule.near_floor || leaves_far_more_held_out(model, fitted));
}

/// The same model by what is held out now.
void judge_again(const Study& study, ScoredModel& model) {
  model = judge(model.entry, std::move(model.fitted), study.held_out, study.observer_hz);
}

/// What was found before is judged like what was found since.
void keep_wider(const Study& study, const FirstSearch& found, std::size_t steps_before, Additions& a) {
  for (std::size_t i = 0; i < steps_before; ++i) {
    judge_again(study, a.steps[i].before);
    for (ScoredModel& c : a.steps[i].candidates) judge_again(study, c);
  }
  a.wider = {study.train, study.held_out, found.before};
  judge_again(study, a.wider->nominal);
}

/// Where something is left of what was fitted another minimum may leave less.
void leave_minimum(const Study& study, ScoredModel& model) {
  if (finish_requested() || at_floor(model) || model.fitted.mean_cost < kExplained) return;
  FittedModel other = searched_from_sheet(study, model.fitted);
  if (other.mean_cost < model.fitted.mean_cost)
    model = judge(model.entry, std::move(other), study.held_out, study.observer_hz);
}

/// The model so far from the drive of a step whose effect has ended at a bound, where it does as well without
/// that effect: what was gained is another minimum of the drive's numbers.
std::optional<ScoredModel> without_empty_effect(const Study& study, const ScoredModel& before,
                                                const FurtherStep& step) {
  const ScoredModel& best = step.candidates.front();
  if (!step.decision.accepted || best.fitted.at_bound.empty() || reads_counts(*best.entry)) return {};
  ScoredModel less = refitted(study, without(best.fitted.model, best.entry));
  const double gained = log_score(before.windows) - less.score;
  if (!(less.score < log_score(best.windows) + kRule.indistinct) || !(gained >= kRule.tells_apart)) return {};
  return less;
}

/// Forward from a candidate of the first step.
Additions follow(Study study, const FirstSearch& found, const ScoredModel& first,
                 std::vector<const EffectEntry*> group) {
  Additions a;
  a.after = first;
  a.effects = {{first.entry, std::move(group)}};
  std::optional<ScoredModel> narrow;  // the model so far, before half of what is held out was fitted
  std::size_t steps_before = 0;
  leave_minimum(study, a.after);
  while (a.steps.size() + 1 < study.effort.most_effects && !at_floor(a.after) && !study.is_exhausted()) {
    a.explained = explained_without(study, a.after);
    if (a.explained) break;
    study.options.progress(fmt::format("looking for a further effect, {} of at most {}", a.steps.size() + 2,
                                       study.effort.most_effects));
    if (asks_elsewhere(study, a.after)) {
      narrow = a.after, steps_before = a.steps.size();
      fit_half_of_the_held_out(study);
      a.after = refitted(study, a.after.fitted.model);
      a.explained = at_floor(a.after);
      if (a.explained) break;
    }
    FurtherStep next = next_step(study, a.after);
    if (next.candidates.empty() && finish_requested()) break;          // given up
    const bool decided = found.decision.accepted || !a.steps.empty();  // else this step has to bear it out
    if (std::optional<ScoredModel> less =
            decided ? without_empty_effect(study, a.after, next) : std::nullopt) {
      a.after = std::move(*less);
      continue;
    }
    a.steps.push_back(std::move(next));
    const FurtherStep& step = a.steps.back();
    if (!step.decision.accepted) break;
    a.after = step.candidates.front();
    a.effects.push_back({a.after.entry, step.decision.group});
    drop_stand_ins(study, a);
    choose_among_look_alikes(study, a);
    take_simpler(study, a);
    leave_minimum(study, a.after);
  }
  if (!narrow) return a;
  if (a.steps.size() > steps_before && a.steps[steps_before].decision.accepted)
    keep_wider(study, found, steps_before, a);
  else
    a.after = std::move(*narrow);
  return a;
}

}  // namespace

const ScoredModel& nominal_of(const FirstSearch& found, const Additions& a) {
  return a.wider ? a.wider->nominal : found.before;
}

const ModelEffect& first_effect(const FirstSearch& found, const Additions& a) {
  const EffectEntry* entry = a.effects.front().entry;
  const auto& effects = a.after.fitted.model.effects;
  if (const auto in = std::ranges::find(effects, entry, &ModelEffect::entry); in != effects.end()) return *in;
  const auto at = std::ranges::find(found.candidates, entry, &ScoredModel::entry);
  return (at == found.candidates.end() ? found.candidates.front() : *at).fitted.model.effects.back();
}

bool leaves_nothing(const Additions& a) { return a.accepted && (a.explained || at_floor(a.after)); }

bool borne_out(const ScoredModel& nominal, const Additions& a) {
  if (a.steps.empty() || !a.steps.front().decision.accepted) return false;
  if (a.explained || at_floor(a.after)) return true;
  // Away from the floor each of the two leaves less than a part, unless the prediction error comes to its
  // floor.
  const bool predicted = a.after.median_innovation < kRule.floor_ratio;
  const double left = predicted ? kRule.all_of_cause : kRule.all_of_free_run;
  return a.steps.front().decision.margin >= kRule.clear &&
         shrink_of(nominal.median_free, a.after.median_free) > 1.0 - left;
}

std::vector<const ScoredModel*> branches(const FirstSearch& found, std::size_t most) {
  std::vector<const ScoredModel*> chosen;
  for (const ScoredModel& c : found.candidates)
    if (chosen.size() < most && worth_following(found.before, c)) chosen.push_back(&c);
  std::vector<const ScoredModel*> fitted;
  for (const ScoredModel& c : found.candidates)
    if (c.fitted.mean_cost < kRule.asked_for * found.before.fitted.mean_cost) fitted.push_back(&c);
  std::stable_sort(fitted.begin(), fitted.end(), [](const ScoredModel* a, const ScoredModel* b) {
    return a->fitted.mean_cost < b->fitted.mean_cost;
  });
  for (std::size_t i = 0; i < std::min(fitted.size(), most); ++i)
    if (std::find(chosen.begin(), chosen.end(), fitted[i]) == chosen.end()) chosen.push_back(fitted[i]);
  return chosen;
}

Additions add_further(const Study& study, const FirstSearch& found) {
  const Decision& sure = found.decision;
  const auto& ranked = found.candidates;
  if (ranked.empty()) return {};
  if (sure.accepted) {
    Additions a = follow(study, found, ranked.front(), sure.group);
    a.accepted = true;
    return a;
  }
  Additions best;
  for (const ScoredModel* first : branches(found, study.effort.branches)) {
    const bool is_best = first == &ranked.front();
    Additions a = follow(study, found, *first, is_best ? sure.group : std::vector{first->entry});
    a.accepted = borne_out(nominal_of(found, a), a) || (is_best && sure.in_part && a.effects.size() > 1);
    const bool better = a.accepted && (!best.accepted || a.after.score < best.after.score);
    if (better || (is_best && !best.accepted)) best = std::move(a);
    if (study.is_exhausted()) break;
    if (best.accepted && (best.explained || at_floor(best.after))) break;
  }
  return best;
}

}  // namespace gapscope::internal::diagnosis
