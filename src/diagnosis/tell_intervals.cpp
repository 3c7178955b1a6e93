#include "diagnosis/tell_intervals.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/tell_budget.h"
#include "gapscope/base/normal.h"

namespace gapscope::internal::diagnosis {
namespace {

/// 95 % intervals of the numbers of a model's effects, by effect and place in its specification.
std::vector<std::vector<Interval>> intervals_of_effects(const Study& study, const FittedModel& fitted) {
  std::vector<std::vector<Interval>> all;
  for (const ModelEffect& e : fitted.model.effects) all.emplace_back(e.entry->parameters.size());
  const reference::ModelFit fit(study.train, fitted.model, study.options.fit, study.observer_hz);
  // A model of the torque balance brings no initial states.
  const auto starts = settled_starts(study.train, fitted.model, study.observer_hz);
  for (const auto& [id, error] : fit.standard_errors(fit.point_of(fitted.model, starts))) {
    if (id.effect < 0 || std::isnan(error)) continue;
    const auto effect = static_cast<std::size_t>(id.effect), index = static_cast<std::size_t>(id.index);
    all[effect][index] = normal_interval(fitted.model.effects[effect].parameters[index].value, error);
  }
  return all;
}

bool are_same(const std::vector<NamedValue>& one, const std::vector<NamedValue>& other) {
  return std::ranges::equal(one, other, [](const NamedValue& a, const NamedValue& b) {
    return a.key == b.key && std::equal_to<>()(a.value, b.value);
  });
}

}  // namespace

void tell_intervals(const Study& study, const FittedModel& fitted, std::vector<AddedEffect>& added) {
  const auto intervals = intervals_of_effects(study, fitted);
  for (AddedEffect& a : added)
    for (std::size_t e = 0; e < intervals.size(); ++e) {
      if (!are_same(a.parameters, effect_values(fitted.model.effects[e]))) continue;
      for (std::size_t i = 0; i < a.parameters.size(); ++i) {
        const Interval& ci95 = intervals[e][i];
        const double turned = a.parameters[i].value - fitted.model.effects[e].parameters[i].value;
        a.parameters[i].ci95 = {ci95.low + turned, ci95.high + turned};  // a phase is told within a turn
      }
    }
}

}  // namespace gapscope::internal::diagnosis
