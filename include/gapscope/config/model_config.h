#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "gapscope/plant/drive.h"
#include "gapscope/plant/plant_model.h"
#include "gapscope/reference/fit.h"

namespace gapscope {

/// One entry of `effects:`. A parameter that is not written has its neutral value.
struct EffectConfig {
  ModelEffect effect;
  int line = 0;
};

/// `model:` – the drive that is fitted, and that a simulation starts from.
/// Keys that are absent: gap, motor_damping and mass_ratio are estimated from a start that the fit derives;
/// load_damping, load_coulomb_friction and contact_damping are 0; the others stay unknown (NaN).
/// Bounds that are absent are NaN: the fit derives them.
struct ModelConfig {
  bool given = false;  ///< false: there is no such block
  DriveStructure structure;
  std::array<ParameterSetting, kDriveParameterCount> parameters;  ///< in the order of kDriveParameters
  std::array<bool, kDriveParameterCount> defaulted{};             ///< the value is not in the file
  std::array<bool, kDriveParameterCount> guessed{};               ///< `guess: true`: nobody has measured it
  std::vector<EffectConfig> effects;
  int line = 0;

  ReferenceModel reference_model() const;
};

/// The plant behind simulated data: `model:` with what `simulation.model:` changes, every number known.
struct SimulatedPlant {
  DriveStructure structure;
  DriveParameters<double> drive;
  std::vector<EffectConfig> effects;

  PlantModel<double> plant_model() const;
};

}  // namespace gapscope
