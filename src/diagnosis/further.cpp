#include "diagnosis/further.h"

#include <algorithm>

namespace gapscope::internal {
namespace {

constexpr std::size_t kMostEffects = 4;
constexpr double kWorthFollowing = 0.3;         ///< S that an unsure first step gains
constexpr double kWorthFollowingWindows = 0.6;  ///< share of the windows that it improves
constexpr std::size_t kBranches = 2;            ///< first steps that are followed where the best is unsure
constexpr double kClearlyBetter = 0.1;          ///< S, of a look-alike
constexpr double kStandIn = 0.15;               ///< S that an earlier effect must still be worth

/// The model so far as the one to add to. An effect that others contain comes last: they take its place.
Judged base_of(const Judged& model) {
  Judged base = model;
  base.entry = nullptr;
  base.score = log_score(model.windows);
  std::stable_partition(
      base.fitted.model.effects.begin(), base.fitted.model.effects.end(), [](const ModelEffect& e) {
        const auto table = effect_table();
        return std::none_of(table.begin(), table.end(),
                            [&](const EffectEntry* child) { return nested_parent(*child) == e.entry; });
      });
  return base;
}

bool worth_following(const Judged& before, const Judged& after) {
  return before.score - after.score >= kWorthFollowing &&
         share_of_windows_better(before, after) >= kWorthFollowingWindows;
}

FurtherStep next_step(const Study& study, const Judged& model) {
  FurtherStep step{base_of(model), {}, {}, {}};
  std::vector<const EffectEntry*> catalogue = study.catalogue;
  std::erase_if(catalogue, [&](const EffectEntry* e) { return contains(model.fitted.model, e); });
  step.candidates = candidates_of(study, step.before, catalogue, false);
  step.decision = decide(step.candidates, step.before, study.repeats_badly(), {});
  return step;
}

FittedModel without(FittedModel model, const EffectEntry* entry) {
  std::erase_if(model.effects, [&](const ModelEffect& e) { return e.entry == entry; });
  return model;
}

Judged refitted(const Study& study, const FittedModel& model) {
  return judge(nullptr, fit_near(study.train, model, study.options.fit, study.observer_hz), study.held_out,
               study.observer_hz);
}

/// Takes out what the last effect has made superfluous.
void drop_stand_ins(const Study& study, Additions& a) {
  const EffectEntry* last = a.effects.back().entry;
  const auto superfluous = [&](const Addition& effect) {
    if (effect.entry == last || !contains(a.after.fitted.model, effect.entry)) return false;
    const Judged less = refitted(study, without(a.after.fitted.model, effect.entry));
    if (!(less.score < log_score(a.after.windows) + kStandIn)) return false;
    a.after = less;
    a.steps.back().dropped.push_back(effect.entry);
    return true;
  };
  std::erase_if(a.effects, superfluous);
}

/// Where an effect was chosen while later ones were still missing, one of its look-alikes may now be better.
void choose_among_look_alikes(const Study& study, Additions& a) {
  for (Addition& effect : a.effects) {
    if (at_floor(a.after)) return;
    if (effect.entry == a.effects.back().entry || !contains(a.after.fitted.model, effect.entry)) continue;
    std::vector<const EffectEntry*> alike{effect.entry};
    for (const EffectEntry* e : study.catalogue)
      if (look_alike(*e, *effect.entry) && !contains(a.after.fitted.model, e)) alike.push_back(e);
    const Judged less = refitted(study, without(a.after.fitted.model, effect.entry));
    std::vector<Judged> ranked = candidates_of(study, base_of(less), alike, false);
    if (ranked.empty() || ranked.front().entry == effect.entry) continue;
    if (!(ranked.front().score < log_score(a.after.windows) - kClearlyBetter)) continue;
    a.steps.back().dropped.push_back(effect.entry);
    effect = {ranked.front().entry, {ranked.front().entry}};
    a.after = std::move(ranked.front());
  }
}

/// Whether a further step has led to the floor. A first step that is there alone has been decided upon.
bool led_to_floor(const Additions& a) {
  return !a.steps.empty() && a.steps.front().decision.accepted && at_floor(a.after);
}

/// Forward from a candidate of the first step.
Additions follow(const Study& study, const Judged& first, std::vector<const EffectEntry*> group) {
  Additions a;
  a.after = first;
  a.effects = {{first.entry, std::move(group)}};
  while (a.steps.size() + 1 < kMostEffects && !at_floor(a.after)) {
    study.options.progress("looking for a further effect");
    a.steps.push_back(next_step(study, a.after));
    const FurtherStep& step = a.steps.back();
    if (!step.decision.accepted) break;
    a.after = step.candidates.front();
    a.effects.push_back({a.after.entry, step.decision.group});
    drop_stand_ins(study, a);
    choose_among_look_alikes(study, a);
  }
  return a;
}

}  // namespace

bool contains(const FittedModel& model, const EffectEntry* entry) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [&](const ModelEffect& e) { return e.entry == entry; });
}

Additions add_further(const Study& study, const Findings& found) {
  const Decision& sure = found.decision;
  const auto& ranked = found.candidates;
  if (ranked.empty() || !(sure.accepted || worth_following(found.before, ranked.front()))) return {};
  Additions a = follow(study, ranked.front(), sure.group);
  a.accepted = sure.accepted || led_to_floor(a) || (sure.in_part && a.effects.size() > 1);
  for (std::size_t i = 1; !a.accepted && i < std::min(kBranches, ranked.size()); ++i) {
    if (!worth_following(found.before, ranked[i])) continue;
    Additions other = follow(study, ranked[i], {ranked[i].entry});
    other.accepted = led_to_floor(other);
    if (other.accepted) a = std::move(other);
  }
  return a;
}

}  // namespace gapscope::internal
