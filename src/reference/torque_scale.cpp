#include "reference/torque_scale.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/plant/effect_hooks.h"
#include "signals/local_motion.h"

namespace gapscope::internal::reference {
namespace {

constexpr double kUsualRatio = 1.0;  ///< load over motor inertia where it is not given

/// Whether the size of an effect is given; an angle beside it may be estimated from where it begins.
bool is_known(const ModelEffect& effect) {
  const std::size_t count = effect.entry->parameters.size();
  return count > 0 && !effect.parameters[0].estimate &&
         std::all_of(effect.parameters.begin(),
                     effect.parameters.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const ParameterSetting& p) { return std::isfinite(p.value); });
}

/// The plant that has nothing but what is known of the effects.
PlantModel<double> known_plant(const ReferenceModel& model) {
  PlantModel<double> plant;
  plant.structure = model.structure;
  for (const ModelEffect& effect : model.effects) {
    if (!is_known(effect)) continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
      values.push_back(effect.parameters[i].value);
    add_effect<double>(plant, *effect.entry, values);
  }
  return plant;
}

bool is_of_the_motion(const ActiveEffect<double>& effect) {
  return effect.hooks->torque != nullptr && effect.hooks->remember == nullptr;
}

/// Speed over the window of local_motion.h about a sample [rad/s].
double speed_at(const MotorTrace& r, std::size_t i, std::size_t half) {
  const std::size_t from = i - std::min(i, half), to = std::min(i + half, r.size() - 1);
  return (r.x1[to] - r.x1[from]) / (r.elapsed(to) - r.elapsed(from));
}

/// What the motor brings against them, both bodies moving as the recorded one [N m].
std::vector<double> known_torque(const MotorTrace& r, PlantModel<double> plant) {
  add_load(plant, 0.0, r.load.gravity);
  std::vector<double> torque(r.size(), 0.0);
  const std::size_t half = signals::speed_window(r) / 2;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double w = speed_at(r, i, half), x = r.x1[i];
    const DriveState<double> state{x, w, x, w};
    for (const ActiveEffect<double>& effect : plant.effects) {
      if (!is_of_the_motion(effect)) continue;
      const EffectPoint<double> at{.state = state, .start = state, .time = r.elapsed(i), .plant = plant};
      const DriveTorque<double> extra = effect.hooks->torque(at, effect.parameters);
      torque[i] -= extra.motor + extra.load;
    }
  }
  return torque;
}

double scale_by(double known, double per_input) {
  return known > 0.0 && per_input > 0.0 ? known / per_input : kNaN;
}

/// Of all that moves with the motor while in contact; NaN where it is not given.
double known_inertia(const ReferenceModel& model) {
  const double motor = model.parameters[place::kMotorInertia].value;
  if (!model.structure.has_load || model.structure.load == LoadKind::kLocked) return motor;
  const double ratio = model.parameters[place::kMassRatio].value;
  return motor * (1.0 + (std::isfinite(ratio) ? ratio : kUsualRatio));
}

}  // namespace

TorqueScale torque_scale(std::span<const MotorTrace> recordings, const ReferenceModel& model) {
  const PlantModel<double> plant = known_plant(model);
  TorqueScale scale;
  if (std::any_of(plant.effects.begin(), plant.effects.end(), is_of_the_motion)) {
    std::vector<std::vector<double>> known;
    for (const MotorTrace& r : recordings) known.push_back(known_torque(r, plant));
    scale.body = signals::as_one_body(recordings, known);
    scale.constant = scale_by(1.0, scale.body.known);
  } else {
    scale.body = signals::as_one_body(recordings);
  }
  const double by_inertia = scale_by(known_inertia(model), scale.body.inertia);
  if (!model.parameters[place::kMotorInertia].estimate && std::isfinite(by_inertia))
    scale.constant = by_inertia;
  const double friction = 0.5 * (plant.motor_friction_plus + plant.motor_friction_minus);
  if (std::isnan(scale.constant)) scale.constant = scale_by(friction, scale.body.friction);
  if (std::isnan(scale.constant)) scale.constant = by_inertia;
  return scale;
}

}  // namespace gapscope::internal::reference
