#pragma once

#include <span>
#include <vector>

#include "gapscope/plant/effect.h"

namespace gapscope {

template <class T>
struct EffectHooks;

constexpr int kMostEffectMemory = 2;

/// An effect that is in force, with its parameters in the order of its specification.
template <class T>
struct ActiveEffect {
  const EffectHooks<T>* hooks = nullptr;
  T parameters[kMostEffectParameters] = {};
};

/// Everything there is to know of a drive: its nine numbers, what it is made of, and the effects in force.
/// What an effect changes once and for all (its `shape` hook) is already in the numbers here.
template <class T>
struct PlantModel {
  DriveParameters<T> drive;
  DriveStructure structure;
  T motor_friction_plus{};    ///< set-valued friction level for w1 > 0 [N m]
  T motor_friction_minus{};   ///< for w1 < 0 [N m]
  T motor_damping_excess{};   ///< d1 is larger by this for w1 > 0, smaller for w1 < 0 [N m s/rad]
  T adhesion{};               ///< tensile torque at which a closed contact parts [N m]
  T load_torque{};            ///< constant torque on the load [N m]
  T gear_friction{};          ///< the motor's friction level grows by it per torque of the gears, < 1 [-]
  bool motor_sticks = false;  ///< the motor's direction matters: reversals are events
  bool gears_rub = false;     ///< gear_friction is in force, be it zero
  bool load_sticks = true;    ///< false: no set-valued friction on the load
  std::vector<ActiveEffect<T>> effects;
};

/// Puts an effect in force: applies its shape and appends it. Parameters in the order of the specification.
template <class T>
void add_effect(PlantModel<T>& plant, const EffectEntry& entry, std::span<const T> parameters);

/// Puts more of the same on the arm: inertia [kg m²] on the load, or on the one body, and weight [N m] on its
/// load_unbalance, where it has one.
template <class T>
void add_load(PlantModel<T>& plant, double inertia, double gravity);

}  // namespace gapscope
