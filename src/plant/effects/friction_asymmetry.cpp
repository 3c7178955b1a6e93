// friction_asymmetry – Coulomb and viscous friction of the motor differ with direction.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct FrictionAsymmetry {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "Fc1 (1 + a sign(w1)) and d1 (1 + b sign(w1)) on the motor";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque},
      {"coulomb_ratio", "-", 0.0, -0.99, 0.99, Scale::kLevel, false,
       "of the mean friction forward, with the opposite sign backward"},
      {"viscous_ratio", "-", 0.0, -0.99, 0.99, Scale::kOne, false,
       "of the mean damping forward, with the opposite sign backward"}};
  static constexpr std::array<const char*, 2> look_alikes = {"constant_load_torque", "load_unbalance"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr const char* contains = "motor_coulomb_friction";
  static constexpr EffectStart starts[] = {
      {0.08, 0.3, 0.15}, {0.08, -0.3, -0.15}, {0.08, 0.3, -0.15}, {0.08, -0.3, 0.15}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.motor_sticks = true;
    plant.motor_friction_plus += p[0] * (1.0 + p[1]);
    plant.motor_friction_minus += p[0] * (1.0 - p[1]);
    plant.motor_damping_excess += plant.drive.motor_damping * p[2];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(friction_asymmetry, FrictionAsymmetry)
