#include "diagnosis/fitted_model.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

/// Keys of the last effect's parameters that have ended at a bound.
std::vector<std::string> at_bounds(const reference::ModelFit& fit, const reference::FitPoint& at) {
  std::vector<std::string> keys;
  const std::vector<ModelEffect>& effects = fit.model().effects;
  for (const reference::ParameterId& id : fit.at_bound(at))
    if (id.effect != reference::ParameterId::kDrive && id.effect + 1 == std::ssize(effects))
      keys.emplace_back(effects.back().entry->parameters[id.index].key);
  return keys;
}

/// Which of its bounds each parameter of the drive has ended at.
std::array<BoundReached, kDriveParameterCount> drive_bounds(const reference::ModelFit& fit,
                                                            const reference::FitPoint& at) {
  std::array<BoundReached, kDriveParameterCount> reached = {};
  const ReferenceModel model = fit.model_at(at);
  for (const reference::ParameterId& id : fit.at_bound(at)) {
    if (id.effect != reference::ParameterId::kDrive) continue;
    const auto i = static_cast<std::size_t>(id.index);
    const Interval bounds = fit.bounds(id);
    const double value = model.parameters[i].value;
    reached[i] = value - bounds.low <= bounds.high - value ? BoundReached::kLower : BoundReached::kUpper;
  }
  return reached;
}

}  // namespace

FittedModel fitted_at(const reference::ModelFit& fit, const reference::RefinedFit& best) {
  const auto is_number = [](double q) { return std::isfinite(q); };
  if (!best.usable() || !std::all_of(best.q.begin(), best.q.end(), is_number))
    return {fit.model(), {}, kInfinity, {}};
  return {fit.model_at(best), best.starts, best.mean_cost, at_bounds(fit, best), drive_bounds(fit, best)};
}

FittedModel fit_nominal(std::span<const MotorTrace> train, const ReferenceModel& model,
                        const FitOptions& options, double hz) {
  const reference::ModelFit fit(train, model, options, hz);
  reference::RefinedFit best;
  if (fit.values_are_given()) best = fit.refine_with_loads_placed(fit.given_point(), {});
  if (best.mean_cost <= kExplained) return fitted_at(fit, best);
  if (const std::optional<reference::FitPoint> found = fit.search())
    if (const reference::RefinedFit other = fit.refine_with_loads_placed(*found, {});
        other.mean_cost < best.mean_cost)
      best = other;
  return fitted_at(fit, best);
}

FittedModel fit_near(std::span<const MotorTrace> recordings, const ReferenceModel& from,
                     const FitOptions& options, double hz, const reference::RefineEffort& effort) {
  const reference::ModelFit fit(recordings, from, options, hz);
  reference::FitPoint point = fit.given_point();
  point.starts =
      settled_starts(recordings, from, hz);  // else the numbers would move for the load's first place
  return fitted_at(fit, fit.refine_with_loads_placed(point, effort));
}

ReferenceModel with_drive(ReferenceModel model, const ReferenceModel& drive) {
  const auto take = [](auto& to, const auto& from) {
    for (std::size_t i = 0; i < to.size(); ++i)
      if (!std::isnan(from[i].value)) to[i].value = from[i].value;
  };
  take(model.parameters, drive.parameters);
  if (model.controller && drive.controller) take(model.controller->numbers, drive.controller->numbers);
  return model;
}

}  // namespace gapscope::internal::diagnosis
