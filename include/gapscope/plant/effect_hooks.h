#pragma once

#include <span>
#include <tuple>

#include "gapscope/plant/effect.h"
#include "gapscope/plant/plant_model.h"
#include "gapscope/plant/scalar.h"

namespace gapscope {

/// Where and when an effect is asked what it does.
template <class T>
struct EffectPoint {
  const DriveState<T>& state;
  const DriveState<T>& start;  ///< of the running step
  T start_time{};              ///< its time [s]
  T time{};                    ///< since the start of the recording [s]
  T drive_torque{};            ///< Km u of the running sample, after the command effects [N m]
  int motor_direction = 0;     ///< sign(w1), kept through zero by the mode; 0: sticking
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
  /// Torque of the closed compliant contact beyond k p + c ṗ, a smooth function of the penetration
  /// p = δ − sβ and of its rate ṗ = δ̇ that is odd in both [N m]. Its `rate` is asked for only where there is
  /// a contact torque.
  T (*contact)(const T& penetration, const T& speed, const PlantModel<T>& plant, const T* p) = nullptr;
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

/// The laws of one effect for every scalar.
struct EffectLaws {
  std::tuple<EffectHooks<double>, EffectHooks<Jet<4>>, EffectHooks<Jet<8>>, EffectHooks<Jet<12>>> hooks;
};

template <class T>
const EffectHooks<T>& hooks_of(const EffectEntry& entry) {
  return std::get<EffectHooks<T>>(entry.laws->hooks);
}

}  // namespace gapscope
