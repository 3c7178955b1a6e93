#include "diagnosis/loop_numbers.h"

#include <algorithm>
#include <cmath>

#include "gapscope/simulation/simulate.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kLeastOf = 1e-6;   ///< of a number that is no less than zero, where nothing bounds it
constexpr double kMostTimes = 1e3;  ///< over its beginning, at most
/// Of the torque that the drive usually brings, with which friction begins.
constexpr double kFirstShare = 0.2;

bool has(const ReferenceModel& model, const char* name) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [&](const ModelEffect& e) { return e.entry == find_effect(name); });
}

ModelEffect effect_with(const char* name, std::initializer_list<ParameterSetting> settings) {
  ModelEffect effect;
  effect.entry = find_effect(name);
  std::copy(settings.begin(), settings.end(), effect.parameters.begin());
  return effect;
}

/// Largest output that the loop asks for at the recorded errors [unit of u].
double largest_output(const Loop& loop, std::span<const MotorTrace> recordings) {
  double most = 0.0;
  for (const MotorTrace& t : recordings)
    for (const double u : commanded_input(loop.controller, t)) most = std::max(most, std::abs(u));
  return most;
}

/// The torque that the drive usually brings: that of what hangs on it, else the median of what the loop asks
/// for [N m].
double usual_torque(const Loop& loop, std::span<const MotorTrace> recordings) {
  for (const ModelEffect& e : loop.model.effects)
    if (e.entry == find_effect("load_unbalance") && e.parameters[0].value > 0.0) return e.parameters[0].value;
  std::vector<double> sizes;
  for (const MotorTrace& t : recordings)
    for (const double u : commanded_input(loop.controller, t)) sizes.push_back(std::abs(u));
  return loop.model.parameters[place::kTorqueConstant].value * median(std::move(sizes));
}

double largest_supply(std::span<const MotorTrace> recordings) {
  double most = 0.0;
  for (const MotorTrace& t : recordings)
    most = std::max(most, *std::max_element(t.command->supply.begin(), t.command->supply.end()));
  return most;
}

double largest_error(std::span<const MotorTrace> recordings) {
  double most = 0.0;
  for (const MotorTrace& t : recordings)
    for (std::size_t i = 0; i < t.size(); ++i)
      most = std::max(most, std::abs(t.command->target[t.command_first + i] - t.x1[i]));
  return most;
}

double usual_error(std::span<const MotorTrace> recordings) {
  std::vector<double> sizes;
  for (const MotorTrace& t : recordings)
    for (std::size_t i = 0; i < t.size(); ++i)
      sizes.push_back(std::abs(t.command->target[t.command_first + i] - t.x1[i]));
  return median(std::move(sizes));
}

/// So many times the torque per unit of the input, with the same limit of torque.
void more_torque(double times, Loop& loop) {
  ParameterSetting& constant = loop.model.parameters[place::kTorqueConstant];
  if (!constant.estimate) return;
  constant.value *= times;
  if (std::isfinite(loop.controller.saturation)) loop.controller.saturation /= times;
}

bool is_ever_off(std::span<const MotorTrace> recordings) {
  return std::any_of(recordings.begin(), recordings.end(),
                     [](const MotorTrace& t) { return t.command->off_from < kInfinity; });
}

/// Whether a number stays at zero or above.
bool is_a_size(const Loop& loop, reference::ParameterId id) {
  if (id.effect == reference::ParameterId::kDrive) return true;
  const EffectParameterSpec& spec = loop.model.effects[static_cast<std::size_t>(id.effect)]
                                        .entry->parameters[static_cast<std::size_t>(id.index)];
  return spec.low >= 0.0 && spec.scale != Scale::kOne;
}

void add_place(const Loop& loop, reference::ParameterId id, std::vector<LoopPlace>& places) {
  Loop copy = loop;
  const ParameterSetting& p = reference::setting_of(copy.model, id);
  if (!p.estimate || !std::isfinite(p.value)) return;
  const bool size = is_a_size(loop, id) && p.value > 0.0;
  double low = p.low, high = p.high;
  if (id.effect >= 0) {
    const EffectParameterSpec& spec = loop.model.effects[static_cast<std::size_t>(id.effect)]
                                          .entry->parameters[static_cast<std::size_t>(id.index)];
    if (spec.scale == Scale::kOne || spec.scale == Scale::kLevel) {
      if (std::isnan(low)) low = spec.low;
      if (std::isnan(high)) high = spec.high;
    }
  }
  if (std::isnan(low)) low = size ? kLeastOf * p.value : -kInfinity;
  if (std::isnan(high)) high = size ? kMostTimes * p.value : kInfinity;
  places.emplace_back(id, size ? 0.0 : std::max(1.0, std::abs(p.value)), low, high);
}

}  // namespace

PlantModel<double> plant_of(const ReferenceModel& model) {
  DriveParameters<double> drive;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (const double value = model.parameters[static_cast<std::size_t>(i)].value; std::isfinite(value))
      drive_parameter(drive, i) = value;
  PlantModel<double> plant = plant_model(drive, model.structure);
  for (const ModelEffect& e : model.effects) {
    std::vector<double> values;
    for (std::size_t i = 0; i < e.entry->parameters.size(); ++i) values.push_back(e.parameters[i].value);
    add_effect<double>(plant, *e.entry, values);
  }
  return plant;
}

double LoopPlace::value(const Loop& loop) const {
  if (is_goal_delay_) return loop.controller.goal_delay;
  if (member_ != nullptr) return loop.controller.*member_;
  ReferenceModel model = loop.model;
  return reference::setting_of(model, id_).value;
}

void LoopPlace::set(double value, Loop& loop) const {
  if (is_goal_delay_)
    loop.controller.goal_delay = value;
  else if (member_ != nullptr)
    loop.controller.*member_ = value;
  else
    reference::setting_of(loop.model, id_).value = value;
}

void LoopPlace::move(Loop& loop, double by) const {
  const double v = value(loop);
  set(std::clamp(scale_ > 0.0 ? v + by * scale_ : v * std::exp(by), low_, high_), loop);
}

LoopNumber LoopPlace::told(const Loop& loop) const {
  const double v = value(loop);
  if (is_goal_delay_) return {"controller.goal_delay_s", "s", v};
  if (member_ != nullptr) return {key_, unit_, v};
  if (id_.effect == reference::ParameterId::kDrive)
    return {kDriveParameters[id_.index].key, kDriveParameters[id_.index].unit, v};
  const EffectEntry& entry = *loop.model.effects[static_cast<std::size_t>(id_.effect)].entry;
  const EffectParameterSpec& spec = entry.parameters[static_cast<std::size_t>(id_.index)];
  return {std::string(entry.name) + "." + spec.key, spec.unit, v};
}

std::vector<LoopPlace> places_of(const Loop& loop, const LoopFitOptions& options) {
  std::vector<LoopPlace> places;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (has_parameter(loop.model.structure, i)) add_place(loop, reference::drive_number(i), places);
  for (std::size_t e = 0; e < loop.model.effects.size(); ++e)
    for (std::size_t i = 0; i < loop.model.effects[e].entry->parameters.size(); ++i)
      add_place(loop, {static_cast<int>(e), static_cast<int>(i)}, places);
  const DriveController& c = loop.controller;
  const auto add = [&](double DriveController::*member, const char* key, const char* unit, double high) {
    places.emplace_back(member, key, unit, kLeastOf * high, high);
  };
  if (options.gain_is_sought && c.kind == ControllerKind::kPosition && c.gain > 0.0)
    add(&DriveController::gain, "controller.position.gain", "unit of u/rad", kMostTimes * c.gain);
  if (options.goal_delay_is_sought && c.goal_delay > 0.0) places.emplace_back(1e-4, 0.5);
  if (options.delay_is_sought && c.delay > 0.0)
    add(&DriveController::delay, "controller.position.delay", "s", 0.3);
  if (c.saturation < kInfinity && options.saturation_is_sought)
    add(&DriveController::saturation, "controller.position.saturation", "unit of u",
        kMostTimes * c.saturation);
  if (c.falls_at < kInfinity && options.fall_is_sought)
    add(&DriveController::falls_at, "controller.position.falls_at", "rad", 100.0);
  if (!std::isnan(c.off_damping) && options.off_damping_is_sought)
    add(&DriveController::off_damping, "controller.off_damping", "N m s/rad", kMostTimes);
  return places;
}

std::vector<LoopAddition> additions_to(const Loop& loop, std::span<const MotorTrace> recordings,
                                       const LoopFitOptions& options) {
  std::vector<LoopAddition> additions;
  const double output = largest_output(loop, recordings), error = largest_error(recordings);
  const double torque = usual_torque(loop, recordings);
  const double damping = loop.model.parameters[place::kMotorDamping].value;
  const double dt = recordings.front().dt;
  if (options.off_damping_is_sought && is_ever_off(recordings))
    additions.push_back({"controller.off_damping",
                         {0.02 * damping, 0.3 * damping},
                         [](Loop& l, double start) { l.controller.off_damping = start; }});
  if (options.saturation_is_sought)
    additions.push_back(
        {"controller.position.saturation",
         {0.3 * output / largest_supply(recordings), 0.7 * output / largest_supply(recordings)},
         [](Loop& l, double start) { l.controller.saturation = start; },
         true});
  if (options.goal_delay_is_sought && !(loop.controller.goal_delay > 0.0))
    additions.push_back({"controller.goal_delay_s",
                         {0.5 * dt, 3.0 * dt},
                         [](Loop& l, double start) { l.controller.goal_delay = start; },
                         true});
  if (options.delay_is_sought && !(loop.controller.delay > 0.0))
    additions.push_back({"controller.position.delay",
                         {0.3 * dt, 2.0 * dt},
                         [](Loop& l, double start) { l.controller.delay = start; },
                         true});
  if (!has(loop.model, "motor_coulomb_friction") && !has(loop.model, "stribeck_friction") &&
      !has(loop.model, "load_dependent_friction"))
    additions.push_back({"motor_coulomb_friction",
                         {0.2 * kFirstShare * torque, kFirstShare * torque},
                         [](Loop& l, double start) {
                           l.model.effects.push_back(
                               effect_with("motor_coulomb_friction", {ParameterSetting::sought(start)}));
                         }});
  if (!has(loop.model, "load_dependent_friction"))
    additions.push_back({"load_dependent_friction", {0.1, 0.3}, [](Loop& l, double start) {
                           l.model.effects.push_back(
                               effect_with("load_dependent_friction",
                                           {ParameterSetting::known(0.0), ParameterSetting::sought(start)}));
                         }});
  if (options.fall_is_sought)
    additions.push_back({"controller.position.falls_at",
                         {0.1 * error, 0.3 * error, error},
                         [usual = usual_error(recordings)](Loop& l, double start) {
                           l.controller.falls_at = start;
                           more_torque(std::hypot(1.0, usual / start), l);
                         },
                         true});
  if (!has(loop.model, "stribeck_friction"))
    additions.push_back({"stribeck_friction", {0.3}, [](Loop& l, double start) {
                           double level = 0.0;
                           std::erase_if(l.model.effects, [&](const ModelEffect& e) {
                             const bool simpler = e.entry == find_effect("motor_coulomb_friction");
                             if (simpler) level += e.parameters[0].value;
                             return simpler;
                           });
                           if (!(level > 0.0)) return;
                           l.model.effects.push_back(
                               effect_with("stribeck_friction",
                                           {ParameterSetting::sought(level), ParameterSetting::sought(start),
                                            ParameterSetting::sought(0.2), ParameterSetting::known(1.0)}));
                         }});
  const bool loads = std::any_of(recordings.begin(), recordings.end(),
                                 [](const MotorTrace& t) { return !t.load.is_none(); });
  if (loads && has(loop.model, "load_unbalance"))
    additions.push_back(
        {"load_unbalance", {0.1}, [](Loop& l, double start) {
           const auto first =
               std::find_if(l.model.effects.begin(), l.model.effects.end(),
                            [](const ModelEffect& e) { return e.entry == find_effect("load_unbalance"); });
           const auto at = [&](std::size_t i) { return ParameterSetting::known(first->parameters[i].value); };
           const ModelEffect arm =
               effect_with("load_unbalance",
                           {ParameterSetting::sought(start * first->parameters[0].value), at(1), at(2)});
           l.model.effects.push_back(arm);
         }});
  return additions;
}

}  // namespace gapscope::internal::diagnosis
