#include "diagnosis/candidates.h"

#include <algorithm>
#include <cmath>

#include "base/cut_short.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Whether the model's last effect is the simpler one that this one contains, and so takes the place of.
bool replaces_last(const ReferenceModel& model, const EffectEntry& entry) {
  return !model.effects.empty() && contained_effect(entry) == model.effects.back().entry;
}

ReferenceModel with_effect(ReferenceModel model, const EffectEntry& entry, const ShaftTurns& turns) {
  if (replaces_last(model, entry)) model.effects.pop_back();
  model.effects.push_back(searched_effect(entry, turns));
  return model;
}

/// A fitted model once more, from where it stands.
FittedModel refined(const Study& study, const FittedModel& from, double hz) {
  const reference::ModelFit fit(study.train, from.model, study.options.fit, hz);
  return fitted_at(fit, fit.refine(fit.point_of(from.model, from.starts), {}));
}

/// The effects of a model as the sheet has them, and those that were added, which it has not, held.
std::vector<ModelEffect> with_added_held(std::vector<ModelEffect> effects, const ReferenceModel& sheet) {
  for (ModelEffect& effect : effects) {
    const auto given = std::ranges::find(sheet.effects, effect.entry, &ModelEffect::entry);
    if (given != sheet.effects.end())
      effect = *given;
    else
      for (ParameterSetting& p : effect.parameters) p.estimate = false;
  }
  return effects;
}

/// The sheet's model with what was added held searched anew, then all of it refined. By the slow observer,
/// which sees what a gap does; nothing where it sees next to nothing left.
FittedModel searched_around_effects(const Study& study, const FittedModel& fitted) {
  if (fitted.searched) return fitted;
  constexpr double hz = kMeasure.slow_hz;
  const double ratio = study.options.fit.rejected_ratio;
  FittedModel same = fitted;
  same.searched = true;
  const FittedModel slow = refined(study, fitted, hz);
  if (!(slow.mean_cost > ratio * ratio) || finish_requested()) return same;
  study.options.progress("looking for the gap again, with what was added");
  ReferenceModel held = study.sheet;
  held.effects = with_added_held(fitted.model.effects, study.sheet);
  FitOptions whole = study.options.fit;
  whole.search_halves = false;  // what is held is not quite right, and leaves too much everywhere
  FittedModel other = fit_nominal(study.train, held, whole, hz);
  if (!(other.mean_cost < slow.mean_cost)) return same;
  for (std::size_t i = 0; i < other.model.effects.size(); ++i)
    if (!has_effect(study.sheet, other.model.effects[i].entry))
      other.model.effects[i] = fitted.model.effects[i];
  other = refined(study, refined(study, other, hz), study.observer_hz);
  return other.mean_cost < fitted.mean_cost ? other : same;
}

}  // namespace

std::vector<reference::FitLinearisation> bases_of(const Study& study, const FittedModel& nominal) {
  const reference::ModelFit fit(study.train, nominal.model, study.options.fit, study.observer_hz);
  std::vector<reference::FitLinearisation> bases;
  for (const ReferenceModel& values : {nominal.model, with_drive(nominal.model, study.sheet)})
    if (std::optional<reference::FitLinearisation> base = fit.linearise(fit.point_of(values, nominal.starts)))
      bases.push_back(std::move(*base));
  return bases;
}

RacedCandidate::RacedCandidate(const Study& study, const FittedModel& nominal,
                               std::span<const reference::FitLinearisation> bases, const EffectEntry& entry,
                               std::span<const EffectStart> starts, const FittedModel* parent)
    : fit_(std::make_unique<reference::ModelFit>(study.train, with_effect(nominal.model, entry, study.turns),
                                                 study.options.fit, study.observer_hz)),
      race_(*fit_, nominal, bases, study.effort) {
  const std::size_t shrinking = replaces_last(nominal.model, entry) ? 1 : 0;  // the base has the first one
  if (entry.start_search == StartSearch::kSine && !starts.empty()) race_.enter_sines(starts.front());
  for (const EffectStart& start : starts) {
    race_.enter(start);
    if (parent != nullptr)
      race_.enter_on(*parent, start);
    else
      race_.weaken(start, shrinking);
  }
}

FittedModel led_by_faster_observer(const Study& study, const FittedModel& candidate) {
  const FittedModel led = refined(study, candidate, kMeasure.fast_hz);
  return led.mean_cost < kInfinity ? refined(study, led, study.observer_hz) : led;
}

FittedModel on_drive_of(const Study& study, const FittedModel& candidate, const ReferenceModel& better) {
  const EffectEntry* mine = candidate.model.effects.back().entry;
  const EffectEntry* others = better.effects.back().entry;
  ReferenceModel moved = with_drive(candidate.model, better);
  if (contained_effect(*others) == mine || contained_effect(*mine) == others)
    moved.effects.back().parameters[0].value = better.effects.back().parameters[0].value;
  // By the numbers of the model without the effect the load may have seemed to start elsewhere.
  const auto settled = settled_starts(study.train, candidate.model, study.observer_hz);
  return refined(study, {moved, settled, kInfinity, {}}, study.observer_hz);
}

FittedModel retry(const Study& study, const FittedModel& candidate, const ReferenceModel& better) {
  const double hz = study.observer_hz;
  const auto settled = settled_starts(study.train, candidate.model, hz);
  FittedModel best = candidate;
  const auto take = [&](FittedModel found) {
    if (found.mean_cost < best.mean_cost) best = std::move(found);
  };
  take(on_drive_of(study, candidate, better));
  for (const ReferenceModel& values : {candidate.model, with_drive(candidate.model, study.sheet)})
    take(refined(study, {values, settled, kInfinity, {}}, hz));
  if (!(best.mean_cost < kExplained) && hz < kMeasure.fast_hz) take(led_by_faster_observer(study, candidate));
  return best;
}

bool seeks_gap(const ReferenceModel& sheet) {
  const ParameterSetting& gap = sheet.parameters[place::kGap];
  return sheet.structure.has_load && sheet.structure.load == LoadKind::kFree && gap.estimate &&
         std::isnan(gap.value);
}

namespace {

/// From the values that the sheet has for what is estimated.
FittedModel searched_from_values(const Study& study, const FittedModel& fitted) {
  const auto is_start = [](const ParameterSetting& p) { return p.estimate && !std::isnan(p.value); };
  const auto& drive = study.sheet.parameters;
  if (std::none_of(drive.begin(), drive.end(), is_start)) return fitted;  // it would set out from itself
  FitOptions given_alone = study.options.fit;
  given_alone.starts = 1;
  FittedModel other =
      fit_nominal(study.train, with_drive(fitted.model, study.sheet), given_alone, study.observer_hz);
  return other.mean_cost < fitted.mean_cost ? other : fitted;
}

}  // namespace

FittedModel searched_from_sheet(const Study& study, const FittedModel& fitted) {
  const auto search = seeks_gap(study.sheet) ? searched_around_effects : searched_from_values;
  return unless_finishing([&] { return search(study, fitted); }).value_or(fitted);
}

bool has_effect(const ReferenceModel& model, const EffectEntry* entry) {
  return std::ranges::find(model.effects, entry, &ModelEffect::entry) != model.effects.end();
}

bool is_candidate(const EffectEntry& entry, const ReferenceModel& model) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == &entry || contained_effect(*e.entry) == &entry) return false;
  if (entry.stands_for >= 0 && model.parameters[entry.stands_for].estimate) return false;
  const bool has_load = model.structure.has_load;
  const ParameterSetting& gap = model.parameters[place::kGap];
  switch (entry.needs) {
    case EffectNeeds::kNothing:
      return true;
    case EffectNeeds::kNoGap:
      return !has_load || (!gap.estimate && !(gap.value > 0.0));
    case EffectNeeds::kContact:
      return has_load && model.structure.contact == ContactLaw::kCompliant;
    case EffectNeeds::kGap:
      return has_load && gap.value > 0.0;
    case EffectNeeds::kFreeLoad:
      return !has_load || model.structure.load == LoadKind::kFree;
  }
  return true;
}

}  // namespace gapscope::internal::diagnosis
