#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
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

/// `anchor:` – what is known of the drive and fixes the scale of its torques, which a recording alone does
/// not: with one of these torque_constant is estimated where nothing is said of it. What is not known is NaN.
struct AnchorConfig {
  double mass = kNaN;         ///< on an arm that turns with x1 [kg]
  double arm = kNaN;          ///< [m]
  ParameterSetting hangs_at;  ///< position at which the arm hangs down [rad]
  double gravity = 9.80665;   ///< [m/s²]
  double inertia = kNaN;      ///< of the motor's side [kg m²]
  double friction = kNaN;     ///< dry, of the motor's side [N m]

  static ParameterSetting about_zero();  ///< of an angle that is not written: it is looked for about 0
  double torque() const;                 ///< of the mass, at most [N m]
  double mass_inertia() const;           ///< [kg m²]
  void take(const AddedLoad& load);      ///< becomes the mass and the arm that have this beyond its own
  std::optional<AnchorConfig> what_hangs() const;  ///< the mass on its arm alone; nothing where there is none
  void fix(ReferenceModel& model) const;
  std::string told(Coordinates coordinates) const;  ///< one sentence
};

/// The plant behind simulated data: `model:` with what `simulation.model:` changes, every number known.
struct SimulatedPlant {
  DriveStructure structure;
  DriveParameters<double> drive;
  std::vector<EffectConfig> effects;

  PlantModel<double> plant_model() const;
};

}  // namespace gapscope
