#include "gapscope/plant/effect.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "gapscope/base/statistics.h"
#include "gapscope/plant/effect_hooks.h"
#include "plant/rival_laws.h"

namespace gapscope {

namespace internal::plant {
#define GAPSCOPE_EFFECT(identifier) extern const EffectEntry effect_##identifier;
#include "plant/effects/effects.inc"
#include "plant/effects/last_resort.inc"
#include "plant/effects/rival_laws.inc"
#undef GAPSCOPE_EFFECT
}  // namespace internal::plant

std::span<const EffectEntry* const> effect_table() {
  static constexpr const EffectEntry* kTable[] = {
#define GAPSCOPE_EFFECT(identifier) &internal::plant::effect_##identifier,
#include "plant/effects/effects.inc"
#undef GAPSCOPE_EFFECT
  };
  return kTable;
}

std::span<const EffectEntry* const> last_resort_table() {
  static constexpr const EffectEntry* kTable[] = {
#define GAPSCOPE_EFFECT(identifier) &internal::plant::effect_##identifier,
#include "plant/effects/last_resort.inc"
#undef GAPSCOPE_EFFECT
  };
  return kTable;
}

std::span<const EffectEntry* const> rival_law_table() {
  static constexpr const EffectEntry* kTable[] = {
#define GAPSCOPE_EFFECT(identifier) &internal::plant::effect_##identifier,
#include "plant/effects/rival_laws.inc"
#undef GAPSCOPE_EFFECT
  };
  return kTable;
}

const EffectEntry* find_effect(std::string_view name) {
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* entry : table)
      if (name == entry->name) return entry;
  return nullptr;
}

const EffectEntry* contained_effect(const EffectEntry& entry) {
  return entry.contains == nullptr ? nullptr : find_effect(entry.contains);
}

double ShaftTurns::of(Shaft shaft) const {
  return shaft == Shaft::kMotor ? motor : shaft == Shaft::kLoad ? load : kNaN;
}

int EffectEntry::period_at() const {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::string_view(parameters[i].key) == "periods_per_turn") return static_cast<int>(i);
  return -1;
}

double neutral_value(const EffectEntry& entry, std::size_t parameter, const ShaftTurns& turns) {
  if (static_cast<int>(parameter) == entry.period_at()) return turns.of(entry.turns_with);
  const EffectParameterSpec& spec = entry.parameters[parameter];
  return spec.absent == 0.0 || spec.scale == Scale::kOne ? spec.absent : kNaN;
}

const char* to_string(ResidualPattern pattern) {
  static constexpr const char* kWords[] = {"angle", "direction",   "speed",  "input",
                                           "time",  "input_steps", "counts", "mode"};
  return kWords[static_cast<int>(pattern)];
}

const char* to_string(ContactPhase phase) {
  static constexpr const char* kWords[] = {"gap", "engagement", "impact"};
  return kWords[static_cast<int>(phase)];
}

const char* to_string(EffectSide side) {
  switch (side) {
    case EffectSide::kMotor:
      return "motor";
    case EffectSide::kLoad:
      return "load";
    case EffectSide::kCommand:
      return "command";
    case EffectSide::kContact:
      return "contact";
    case EffectSide::kSensor:
      return "sensor";
  }
  return "";
}

double scale_value(Scale scale, const ScaleContext& c) {
  const double torque = c.nominal.torque_constant * c.peak_input;
  const double k = c.nominal.contact_stiffness;
  switch (scale) {
    case Scale::kOne:
    case Scale::kLevel:
      return 1.0;
    case Scale::kPeakTorque:
      return torque;
    case Scale::kPeakInput:
      return c.peak_input;
    case Scale::kPeakSpeed:
      return c.peak_speed;
    case Scale::kTorquePerSpeed:
      return torque / c.peak_speed;
    case Scale::kTorquePerSpeed2:
      return torque / (c.peak_speed * c.peak_speed);
    case Scale::kPeakPower:
      return torque * c.peak_speed;
    case Scale::kTravel:
      return c.travel;
    case Scale::kQuantum:
      return c.quantum;
    case Scale::kGap:
      return c.nominal.gap;
    case Scale::kGapPerRecord:
      return c.nominal.gap / c.duration;
    case Scale::kPenetration:
      return torque / c.nominal.contact_stiffness;
    case Scale::kStiffness:
      return k;
    case Scale::kContactDamping:
      return std::max(c.nominal.contact_damping, 0.1 * std::sqrt(k * c.nominal.motor_inertia));
    case Scale::kSample:
      return c.dt;
    case Scale::kRecord:
      return c.duration;
    case Scale::kPerRecord:
      return 1.0 / c.duration;
    case Scale::kPerTravel:
      return 2.0 * kPi / c.travel;
  }
  return 1.0;
}

template <class T>
void add_effect(PlantModel<T>& plant, const EffectEntry& entry, std::span<const T> parameters) {
  GAPSCOPE_REQUIRE(parameters.size() == entry.parameters.size());
  ActiveEffect<T> effect;
  effect.hooks = &hooks_of<T>(entry);
  std::copy(parameters.begin(), parameters.end(), effect.parameters);
  if (effect.hooks->shape != nullptr) effect.hooks->shape(plant, effect.parameters);
  plant.effects.push_back(effect);
}

template <class T>
void add_load(PlantModel<T>& plant, double inertia, double gravity) {
  if (plant.structure.has_load)
    plant.drive.mass_ratio += inertia / plant.drive.motor_inertia;
  else
    plant.drive.motor_inertia += inertia;
  const EffectHooks<T>* hangs = &hooks_of<T>(internal::plant::effect_load_unbalance);
  for (ActiveEffect<T>& effect : plant.effects)
    if (effect.hooks == hangs) {
      effect.parameters[0] += gravity;
      return;
    }
}

template void add_effect(PlantModel<double>&, const EffectEntry&, std::span<const double>);
template void add_effect(PlantModel<Jet<4>>&, const EffectEntry&, std::span<const Jet<4>>);
template void add_effect(PlantModel<Jet<8>>&, const EffectEntry&, std::span<const Jet<8>>);
template void add_effect(PlantModel<Jet<12>>&, const EffectEntry&, std::span<const Jet<12>>);
template void add_load(PlantModel<double>&, double, double);
template void add_load(PlantModel<Jet<4>>&, double, double);
template void add_load(PlantModel<Jet<8>>&, double, double);
template void add_load(PlantModel<Jet<12>>&, double, double);

}  // namespace gapscope
