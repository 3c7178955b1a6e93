#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "gapscope/plant/plant_model.h"

namespace gapscope {

enum class EffectSide { kMotor, kLoad, kCommand, kContact, kSensor };
const char* to_string(EffectSide side);  ///< "motor", "load", "command", "contact", "sensor"

/// What the bounds of a parameter are measured in: never absolute, always of the drive and the recording.
enum class Scale {
  kOne,              ///< plain numbers and angles
  kPeakTorque,       ///< Km max|u| [N m]
  kPeakInput,        ///< max|u|
  kPeakSpeed,        ///< largest motor speed of the recording [rad/s]
  kTorquePerSpeed,   ///< peak torque over peak speed
  kTorquePerSpeed2,  ///< peak torque over peak speed squared
  kTravel,           ///< range of x1 in the recording [rad]
  kQuantum,          ///< of the encoder [rad]
  kGap,              ///< nominal backlash gap [rad]
  kGapPerRecord,     ///< nominal gap over the duration [rad/s]
  kStiffness,        ///< nominal contact stiffness [N m/rad]
  kContactDamping,   ///< nominal contact damping, at least a tenth of √(k m1) [N m s/rad]
  kSample,           ///< sampling interval [s]
  kRecord,           ///< duration [s]
  kPerTravel,        ///< one cycle over the travel [1/rev]
};

/// What the scales are measured on.
struct ScaleContext {
  double peak_input = 1.0;
  double peak_speed = 1.0;  ///< [rad/s]
  double travel = 1.0;      ///< [rad]
  double quantum = 1e-6;    ///< [rad]
  double dt = 1e-3;         ///< [s]
  double duration = 1.0;    ///< [s]
  DriveParameters<double> nominal;
};
double scale_value(Scale scale, const ScaleContext& context);

struct EffectParameterSpec {
  const char* key;
  const char* unit;
  double absent;  ///< value at which the effect vanishes, or a neutral one, in units of the scale
  double low;     ///< bounds, in units of the scale
  double high;
  Scale scale;
};

/// Where and when an effect is asked what it does.
template <class T>
struct EffectPoint {
  const DriveState<T>& state;
  T time{};                 ///< since the start of the recording [s]
  T drive_torque{};         ///< Km u of the running sample, after the command effects [N m]
  int motor_direction = 0;  ///< sign(w1), kept through zero by the mode; 0: sticking
  const PlantModel<T>& plant;
  const T* memory = nullptr;  ///< of this effect, as of the start of the step
};

template <class T>
struct DriveTorque {
  T motor{}, load{};  ///< [N m]
};

/// An extra torque on the motor that dies away within a step of constant input: amplitude · exp(−rate · s).
template <class T>
struct DecayingTorque {
  T amplitude{};  ///< at the point that was asked for [N m]
  T rate{};       ///< [1/s], the same at every point
};

/// The laws of one effect for one scalar; what an effect does not do stays null.
template <class T>
struct EffectHooks {
  /// Changes the numbers of the drive once: friction levels, stiffness, gap.
  void (*shape)(PlantModel<T>& plant, const T* p) = nullptr;
  /// Input that acts in place of u.
  T (*command)(const T& u, const T* p) = nullptr;
  /// Time by which the input acts later [s].
  T (*delay)(const T* p) = nullptr;
  /// Extra torque on either side, a smooth function of the point between events.
  DriveTorque<T> (*torque)(const EffectPoint<T>& at, const T* p) = nullptr;
  /// Extra torque that is followed exactly; at most one effect of a drive may have one.
  DecayingTorque<T> (*decay)(const EffectPoint<T>& at, const T* p) = nullptr;
  /// Added to the half gap β [rad].
  T (*half_gap)(const EffectPoint<T>& at, const T* p) = nullptr;
  /// Load inertia over its nominal value [-].
  T (*load_inertia)(const T& time, const T* p) = nullptr;
  /// What the encoder would say of x1 [rad].
  T (*sense)(const EffectPoint<T>& at, const T* p) = nullptr;
  /// Memory at the start of a motion, and after a step of smooth motion from one point to another.
  void (*remember)(const EffectPoint<T>& start, T* memory, const T* p) = nullptr;
  void (*advance)(const EffectPoint<T>& from, const EffectPoint<T>& to, T* memory, const T* p) = nullptr;
  /// Fastest rate of the effect at a point [1/s]; steps that are long against it are divided.
  double (*rate)(const EffectPoint<T>& at, const T* p) = nullptr;
  /// Quantum of the encoder in place of the sheet's [rad].
  double (*quantum)(const T* p) = nullptr;
};

/// One row of the catalogue.
struct EffectEntry {
  const char* name;
  EffectSide side;
  const char* law;
  std::span<const EffectParameterSpec> parameters;
  std::span<const char* const> look_alikes;
  const EffectHooks<double>* hooks_double;
  const EffectHooks<Jet<4>>* hooks_jet4;
  const EffectHooks<Jet<8>>* hooks_jet8;
  const EffectHooks<Jet<12>>* hooks_jet12;

  template <class T>
  const EffectHooks<T>* hooks() const {
    if constexpr (std::is_same_v<T, double>) return hooks_double;
    if constexpr (std::is_same_v<T, Jet<4>>) return hooks_jet4;
    if constexpr (std::is_same_v<T, Jet<8>>) return hooks_jet8;
    if constexpr (std::is_same_v<T, Jet<12>>) return hooks_jet12;
  }
};

/// The catalogue, sorted by name.
std::span<const EffectEntry* const> effect_table();

/// nullptr if there is none of that name.
const EffectEntry* find_effect(std::string_view name);

/// Puts an effect in force: applies its shape and appends it. Parameters in the order of the specification.
template <class T>
void add_effect(PlantModel<T>& plant, const EffectEntry& entry, std::span<const T> parameters);

extern template void add_effect(PlantModel<double>&, const EffectEntry&, std::span<const double>);
extern template void add_effect(PlantModel<Jet<4>>&, const EffectEntry&, std::span<const Jet<4>>);
extern template void add_effect(PlantModel<Jet<8>>&, const EffectEntry&, std::span<const Jet<8>>);
extern template void add_effect(PlantModel<Jet<12>>&, const EffectEntry&, std::span<const Jet<12>>);

}  // namespace gapscope
