// presliding_friction – a bristle (Dahl) that has to be bent before the motor slides.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct PreslidingFriction {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "motor torque -(Fc1 z + s dz/dx w1), dz/dx = (1 - sign(w1) z)/length";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque},
      {"length_rad", "rad", 0.01, 1e-4, 0.3, Scale::kTravel},
      {"damping_nms", "N m s/rad", 0.0, 0.0, 1.0, Scale::kTorquePerSpeed}};
  static constexpr std::array<const char*, 2> look_alikes = {"motor_coulomb_friction", "stribeck_friction"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr const char* contains = "motor_coulomb_friction";
  static constexpr EffectStart starts[] = {{0.05, 0.02, 0.001}, {0.15, 0.03, 0.003}, {0.1, 0.01, 0.001}};

  // Between reversals the deflection follows the travel in closed form:
  //   z(x1) = σ + (z0 − σ) exp(−|x1 − x0|/length),   σ = sign(w1).   Memory: x0, z0.
  template <class T>
  static void shape(PlantModel<T>& plant, const T*) {
    plant.motor_sticks = true;  // level zero: reversals are located, nothing holds the motor
  }

  template <class T>
  static T deflection(const EffectPoint<T>& at, const T* memory, const T* p) {
    using std::exp;
    const double direction = at.motor_direction;
    if (at.motor_direction == 0) return memory[1];
    const T travel = direction * (at.state.x1 - memory[0]);
    return direction + (memory[1] - direction) * exp(-travel / p[1]);
  }

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const T z = deflection(at, at.memory, p);
    const T bending = 1.0 - static_cast<double>(at.motor_direction) * z;
    return {.motor = -(p[0] * z + p[2] * bending * at.state.w1)};
  }

  template <class T>
  static void remember(const EffectPoint<T>& start, T* memory, const T*) {
    memory[0] = start.state.x1;
    memory[1] = T(0.0);
  }

  template <class T>
  static void advance(const EffectPoint<T>&, const EffectPoint<T>& to, T* memory, const T* p) {
    memory[1] = deflection(to, memory, p);
    memory[0] = to.state.x1;
  }

  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const double m1 = value_of(at.plant.drive.motor_inertia);
    return std::sqrt(value_of(p[0]) / (value_of(p[1]) * m1)) + value_of(p[2]) / m1;
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(presliding_friction, PreslidingFriction)
