// friction_curve – law of last resort: a friction that is any function of speed, in each direction.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"
#include "plant/effects/node_curve.h"

namespace gapscope::internal::plant {
namespace {

/// The mean of both directions ends in zero at the largest speed: what grows with the speed throughout is
/// viscous friction.
struct FrictionCurve {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law =
      "motor torque -s F(|w1|), s = sign(w1), set-valued at rest; F is the natural cubic spline through "
      "torque_k + s skew_k at (k/6)^2 peak_speed, torque_6 = 0, and levels off from there on";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"peak_speed_rad_s", "rad/s", 1.0, 1.0, 1.0, Scale::kPeakSpeed},
      {"torque_0_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"torque_1_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"torque_2_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"torque_3_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"torque_4_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"torque_5_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_0_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_1_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_2_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_3_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_4_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_5_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"skew_6_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque}};
  static constexpr std::array<const char*, 5> look_alikes = {
      "motor_coulomb_friction", "stribeck_friction", "friction_asymmetry", "quadratic_drag", "viscous_drift"};
  static constexpr ResidualPattern follows = ResidualPattern::kSpeed;
  static constexpr int kNodes = 6;

  template <class T>
  static T level(int k, double direction, const T* p) {
    const T skew = direction * p[1 + kNodes + k];
    return k < kNodes ? T(p[1 + k] + skew) : skew;
  }

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.motor_sticks = true;
    plant.motor_friction_plus += level(0, 1.0, p);
    plant.motor_friction_minus += level(0, -1.0, p);
  }

  /// What the sliding motor feels beside its level at rest.
  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    if (at.motor_direction == 0) return {};
    const double s = at.motor_direction;
    const T speed = s * at.state.w1 / p[0];
    const T felt = along_nodes<kNodes, Beyond::kLevel>(speed, [&](int k) { return level(k, s, p); });
    return {.motor = -s * (felt - level(0, s, p))};
  }

  /// Speed passes from node to node at this rate, at the most that the torque in force can do.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const double peak = value_of(p[0]);
    const int piece = piece_at<kNodes>(std::abs(value_of(at.state.w1)) / peak);
    if (piece == kNodes) return 0.0;
    const double slope = std::abs(value_of(p[1 + piece])) + std::abs(value_of(p[7 + piece]));
    return 2.0 * (std::abs(value_of(at.drive_torque)) + slope) /
           (value_of(at.plant.drive.motor_inertia) * peak * Nodes<kNodes>::width(piece));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(friction_curve, FrictionCurve)
