// stribeck_friction – dry friction that falls from its break-away level as the motor starts to move.
#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"
#include "plant/effects/smooth_functions.h"

namespace gapscope::internal::plant {
namespace {

struct StribeckFriction {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law =
      "motor torque -Fc1 (1 + r exp(-|w1/vs|^d)) sign(w1), set-valued at rest; r < 0: less friction at low speed";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque},
      {"stiction_ratio", "-", 0.0, -0.9, 5.0, Scale::kLevel, false, "of the Coulomb friction, at standstill"},
      {"stribeck_speed_rad_s", "rad/s", 0.05, 1e-3, 1.0, Scale::kPeakSpeed},
      {"exponent", "-", 2.0, 0.5, 3.0, Scale::kOne}};
  static constexpr std::array<const char*, 3> look_alikes = {"motor_coulomb_friction", "presliding_friction",
                                                             "quadratic_drag"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr const char* contains = "motor_coulomb_friction";
  static constexpr EffectStart starts[] = {
      {0.05, 0.8, 0.1, 1.5}, {0.1, 0.8, 0.25, 1.5}, {0.1, -0.6, 0.1, 1.5}};

  /// A power below one has no slope at rest.
  static constexpr double kRounding = 1e-12;

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.motor_sticks = true;
    plant.motor_friction_plus += p[0] * (1.0 + p[1]);
    plant.motor_friction_minus += p[0] * (1.0 + p[1]);
  }

  /// What the sliding motor is spared of its break-away level; zero at rest.
  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    using std::exp;
    const T v = at.state.w1 / p[2];
    return {.motor = static_cast<double>(at.motor_direction) * p[0] * p[1] *
                     (1.0 - exp(-power(T(v * v + kRounding), T(0.5 * p[3]))))};
  }

  /// Speed passes through the law's width at this rate, at the most that the torque in force can do;
  /// half as fast again, since the law bends twice within its width, and faster the sharper it bends at rest.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    if (std::abs(value_of(at.state.w1)) > 4.0 * value_of(p[2])) return 0.0;
    const double torque =
        std::abs(value_of(at.drive_torque)) + value_of(p[0]) * std::max(1.0, 1.0 + value_of(p[1]));
    return 3.0 * torque / (value_of(at.plant.drive.motor_inertia) * value_of(p[2]) * value_of(p[3]));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(stribeck_friction, StribeckFriction)
