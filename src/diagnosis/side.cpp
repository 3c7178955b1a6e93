#include "diagnosis/side.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/fitted_model.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Windows come in floors: of one radian, they are what they are.
HeldOut in_radians(HeldOut held_out) {
  std::fill(held_out.floors.begin(), held_out.floors.end(), 1.0);
  return held_out;
}

double judged_error(const Side& side, const ReferenceModel& model) {
  const std::vector<Playback> played = play(model, side.judged, side.observer_hz, false);
  if (played.empty()) return kInfinity;
  const std::vector<double> squares = windows_of(played, side.judged).free;
  return squares.empty() ? kInfinity : std::sqrt(mean(squares));
}

}  // namespace

Side side_of(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out, double observer_hz,
             const DiagnosisOptions& options) {
  Study study = make_study(train, held_out, {}, options);
  return {std::move(study.train), in_radians(std::move(study.held_out)), observer_hz, options.fit};
}

SideFit fit_side(const Side& side, const ReferenceModel& from) {
  FittedModel fitted = fit_near(side.train, from, side.fit, side.observer_hz);
  if (!std::isfinite(fitted.mean_cost)) return {};
  const double error = judged_error(side, fitted.model);
  return {std::move(fitted.model), std::move(fitted.starts), error};
}

std::vector<double> spreads_of(const Side& side, const SideFit& fit,
                               const std::vector<reference::ParameterId>& ids) {
  const reference::ModelFit at(side.train, fit.model, side.fit, side.observer_hz);
  std::vector<reference::WeightedSum> sums;
  for (const reference::ParameterId& id : ids) sums.push_back({{id, 1.0}});
  std::vector<double> spreads = at.spreads(at.point_of(fit.model, fit.starts), sums);
  spreads.resize(ids.size(), kNaN);
  for (double& spread : spreads)
    if (!(spread > 0.0)) spread = kNaN;
  return spreads;
}

double excess(const SideFit& pinned, const SideFit& free) {
  return std::sqrt(std::max(0.0, pinned.error * pinned.error - free.error * free.error));
}

ReferenceModel with_numbers(ReferenceModel model, const ReferenceModel& by,
                            const std::vector<reference::ParameterId>& ids) {
  ReferenceModel source = by;
  for (const reference::ParameterId& id : ids) setting_of(model, id).value = setting_of(source, id).value;
  return model;
}

ReferenceModel pinned(ReferenceModel model, const ReferenceModel& at,
                      const std::vector<reference::ParameterId>& ids) {
  ReferenceModel there = with_numbers(std::move(model), at, ids);
  for (const reference::ParameterId& id : ids) setting_of(there, id).estimate = false;
  return there;
}

}  // namespace gapscope::internal::diagnosis
