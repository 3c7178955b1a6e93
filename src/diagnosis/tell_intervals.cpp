#include "diagnosis/tell_intervals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "diagnosis/tell_budget.h"
#include "gapscope/base/normal.h"

namespace gapscope::internal::diagnosis {
namespace {

using StandardErrors = std::vector<std::pair<reference::ParameterId, double>>;

/// What the fit says of its numbers.
struct FitErrors {
  StandardErrors errors;
  std::vector<reference::ParameterId> at_bound;
};

FitErrors errors_of(const Study& study, const FittedModel& fitted) {
  const reference::ModelFit fit(study.train, fitted.model, study.options.fit, study.observer_hz);
  // A model of the torque balance brings no initial states.
  const auto starts = settled_starts(study.train, fitted.model, study.observer_hz);
  const reference::FitPoint at = fit.point_of(fitted.model, starts);
  return {fit.standard_errors(at), fit.at_bound(at)};
}

/// 95 % intervals of the numbers of a model's effects, by effect and place in its specification.
std::vector<std::vector<Interval>> intervals_of_effects(const ReferenceModel& model,
                                                        const StandardErrors& errors) {
  std::vector<std::vector<Interval>> all;
  for (const ModelEffect& e : model.effects) all.emplace_back(e.entry->parameters.size());
  for (const auto& [id, error] : errors) {
    if (id.effect < 0 || std::isnan(error)) continue;
    const auto effect = static_cast<std::size_t>(id.effect), index = static_cast<std::size_t>(id.index);
    all[effect][index] = normal_interval(model.effects[effect].parameters[index].value, error);
  }
  return all;
}

bool are_same(const std::vector<NamedValue>& one, const std::vector<NamedValue>& other) {
  return std::ranges::equal(one, other, [](const NamedValue& a, const NamedValue& b) {
    return a.key == b.key && std::equal_to<>()(a.value, b.value);
  });
}

/// Keys of an effect's parameters that have ended at a bound.
std::vector<std::string> at_bound_of(const EffectEntry& entry, std::size_t effect, const FitErrors& fit) {
  std::vector<std::string> keys;
  for (const reference::ParameterId& id : fit.at_bound)
    if (id.effect == static_cast<int>(effect))
      keys.emplace_back(entry.parameters[static_cast<std::size_t>(id.index)].key);
  return keys;
}

void tell_added_intervals(const ReferenceModel& model, const FitErrors& fit,
                          std::vector<AddedEffect>& added) {
  const auto intervals = intervals_of_effects(model, fit.errors);
  for (AddedEffect& a : added)
    for (std::size_t e = 0; e < intervals.size(); ++e) {
      if (!are_same(a.parameters, effect_values(model.effects[e]))) continue;
      a.at_bound = at_bound_of(*model.effects[e].entry, e, fit);
      for (std::size_t i = 0; i < a.parameters.size(); ++i) {
        const Interval& ci95 = intervals[e][i];
        const double turned = a.parameters[i].value - model.effects[e].parameters[i].value;
        a.parameters[i].ci95 = {ci95.low + turned, ci95.high + turned};  // a phase is told within a turn
      }
    }
}

/// Of the coupling; of one body, of an effect that gives it a gap.
ModelGap gap_of(const ReferenceModel& model, const std::vector<AddedEffect>& added) {
  const ParameterSetting &ratio = model.parameters[place::kMassRatio], &gap = model.parameters[place::kGap];
  if (has_parameter(model.structure, place::kGap) && (ratio.estimate || ratio.value != 0.0))
    return {gap.estimate ? GapOrigin::kEstimated : GapOrigin::kGiven, gap.value, {}};
  for (const AddedEffect& a : added)
    for (const NamedValue& p : a.parameters)
      if (a.effect == "backlash" && p.key == "gap_rad") return {GapOrigin::kEstimated, p.value, p.ci95};
  return {};
}

}  // namespace

void tell_intervals(const Study& study, const FittedModel& fitted, Diagnosis& d) {
  d.model_gap = gap_of(fitted.model, d.added);
  const bool asked = !d.added.empty() || d.model_gap->origin == GapOrigin::kEstimated;
  if (!asked || !std::isfinite(fitted.mean_cost)) return;
  const FitErrors fit = errors_of(study, fitted);
  tell_added_intervals(fitted.model, fit, d.added);
  d.model_gap = gap_of(fitted.model, d.added);
  for (const auto& [id, error] : fit.errors)
    if (id == reference::drive_number(place::kGap) && !std::isnan(error))
      d.model_gap->ci95 = normal_interval(d.model_gap->value, error);
}

}  // namespace gapscope::internal::diagnosis
