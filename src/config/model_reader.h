#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "config/model_config.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// A parameter as it is written; what is not written is absent.
struct WrittenParameter {
  std::optional<double> value;
  std::optional<bool> estimate;
  std::optional<std::pair<double, double>> bounds;
  std::optional<std::pair<std::optional<double>, double>> prior;  ///< value and std
  Value place;
  bool guess = false;                  ///< the value is one
  std::optional<Value> given_at = {};  ///< "motor" or "load": the side of the gear that the numbers hold at
};

/// A `model:` block as it is written.
struct WrittenModel {
  bool given = false;
  std::optional<std::pair<ContactLaw, double>> contact;  ///< with the restitution
  std::optional<LoadKind> load;
  std::array<std::optional<WrittenParameter>, kDriveParameterCount> parameters;
  std::optional<std::vector<EffectConfig>> effects;
  std::optional<Value> place;
};

/// What a drive parameter can be at all, by its place in kDriveParameters.
Range possible_parameter(int index);

/// What a parameter of an effect can be at all.
Range possible(const EffectParameterSpec& spec);

/// Of the inertias, load over motor [-]: 0 is another structure.
inline constexpr double kSmallestRatio = 1e-3;

/// A period as a length, in place of a number of periods per turn.
inline constexpr const char* kPeriodKey = "period_rad";
inline constexpr Range kPossiblePeriod = {1e-15, 1e15, "rad"};

WrittenModel read_model(const Value& value);

/// Numbers that are given at the motor's shaft become those of the axis behind the gear, which the model
/// moves.
/// @param recording  whose gear_ratio says how many turns the motor makes for one of that axis
/// @throws ConfigError at given_at: where there is no such gear, on a slide, and of a number without a side
void put_behind_gear(WrittenModel& model, const std::optional<Value>& recording, Coordinates coordinates);

/// `base` with everything that `changes` writes. A parameter of both keeps what only the base says.
WrittenModel overlaid(const WrittenModel& base, const WrittenModel& changes);

/// The rules of the structure applied: what is estimated, what does not exist, what contradicts.
ModelConfig resolved_model(const WrittenModel& written);

/// The plant of a simulation: every parameter of its structure needs a number.
/// @param simulation  the block that needs them, for messages
SimulatedPlant simulated_plant(const WrittenModel& written, const Value& simulation);

/// An effect of the catalogue.  @throws ConfigError at the value, with the nearest name
const EffectEntry& effect_named(const std::string& name, const Value& value);

/// `{name: {key: number, key: {value, estimate, bounds}}}` of a known effect.
EffectConfig read_effect(const Value& value);

/// Effects that come once per turn, and whose period is not written, get that of the shaft they turn with.
/// @throws ConfigError at the effect where nothing turns
void settle_periods(std::vector<EffectConfig>& effects, const ShaftTurns& turns, const std::string& file);

}  // namespace gapscope::internal::config
