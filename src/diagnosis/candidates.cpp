#include "diagnosis/candidates.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

constexpr reference::RefineEffort kRetry{8, 40, 1e-4};  ///< of the few that came nearest
constexpr double kFurther = 0.995;                      ///< of the mean square: a retry that got further

/// Whether the model's last effect is the simpler one that this one contains, and so takes the place of.
bool replaces_last(const ReferenceModel& model, const EffectEntry& entry) {
  return !model.effects.empty() && contained_effect(entry) == model.effects.back().entry;
}

ReferenceModel with_effect(ReferenceModel model, const EffectEntry& entry) {
  if (replaces_last(model, entry)) model.effects.pop_back();
  ModelEffect effect;
  effect.entry = &entry;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) effect.parameters[i].estimate = true;
  model.effects.push_back(effect);
  return model;
}

/// A fitted model once more with more work, from where it stands.
FittedModel refined(std::span<const MotorTrace> train, const FittedModel& from, const FitOptions& options,
                    double hz) {
  const reference::ModelFit fit(train, from.model, options, hz);
  return fitted_at(fit, fit.refine(fit.point_of(from.model, from.starts), kRetry));
}

}  // namespace

std::vector<reference::FitLinearisation> bases_of(std::span<const MotorTrace> train,
                                                  const FittedModel& nominal, const ReferenceModel& sheet,
                                                  const FitOptions& options, double hz) {
  const reference::ModelFit fit(train, nominal.model, options, hz);
  std::vector<reference::FitLinearisation> bases;
  for (const ReferenceModel& values : {nominal.model, with_drive(nominal.model, sheet)})
    if (std::optional<reference::FitLinearisation> base = fit.linearise(fit.point_of(values, nominal.starts)))
      bases.push_back(std::move(*base));
  return bases;
}

RacedCandidate::RacedCandidate(std::span<const MotorTrace> train, const FittedModel& nominal,
                               std::span<const reference::FitLinearisation> bases, const EffectEntry& entry,
                               std::span<const EffectStart> starts, const FittedModel* parent,
                               const FitOptions& options, double hz)
    : fit_(std::make_unique<reference::ModelFit>(train, with_effect(nominal.model, entry), options, hz)),
      race_(*fit_, nominal, bases) {
  const std::size_t shrinking = replaces_last(nominal.model, entry) ? 1 : 0;  // the base has the first one
  if (entry.start_search == StartSearch::kSine && !starts.empty()) race_.enter_sines(starts.front());
  for (const EffectStart& start : starts) {
    race_.enter(start);
    if (parent != nullptr)
      race_.enter_on(*parent, start);
    else
      race_.weaken(start, shrinking);
  }
  race_.finish();
}

FittedModel led_by_faster_observer(std::span<const MotorTrace> train, const FittedModel& candidate,
                                   const FitOptions& options, double hz) {
  const FittedModel led = refined(train, candidate, options, kFastHz);
  return led.mean_cost < kInfinity ? refined(train, led, options, hz) : led;
}

FittedModel retry(std::span<const MotorTrace> train, const FittedModel& candidate,
                  const ReferenceModel& other, const ReferenceModel& sheet, const FitOptions& options,
                  double hz) {
  const EffectEntry* mine = candidate.model.effects.back().entry;
  const EffectEntry* others = other.effects.back().entry;
  ReferenceModel moved = with_drive(candidate.model, other);
  if (contained_effect(*others) == mine || contained_effect(*mine) == others)
    moved.effects.back().parameters[0].value = other.effects.back().parameters[0].value;
  // By the numbers of the model without the effect the load may have seemed to start elsewhere.
  const std::vector<reference::RecordingStart> settled = settled_starts(train, candidate.model, hz);
  FittedModel best = candidate;
  const auto take = [&](FittedModel found) {
    if (found.mean_cost < kFurther * best.mean_cost) best = std::move(found);
  };
  for (const ReferenceModel& values : {candidate.model, moved, with_drive(candidate.model, sheet)})
    take(refined(train, {values, settled, kInfinity, {}}, options, hz));
  if (!(best.mean_cost < kFloorSquare) && hz < kFastHz)
    take(led_by_faster_observer(train, candidate, options, hz));
  return best;
}

bool is_candidate(const EffectEntry& entry, const ReferenceModel& model) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == &entry || contained_effect(*e.entry) == &entry) return false;
  if (entry.stands_for >= 0 && model.parameters[static_cast<std::size_t>(entry.stands_for)].estimate)
    return false;
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
