// motor_coulomb_friction – dry friction on the motor side, set-valued at rest.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct MotorCoulombFriction {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "motor torque -Fc1 sign(w1), set-valued at rest";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque}};
  static constexpr std::array<const char*, 3> look_alikes = {"input_dead_zone", "stribeck_friction",
                                                             "presliding_friction"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr EffectStart starts[] = {{0.02}, {0.1}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.motor_sticks = true;
    plant.motor_friction_plus += p[0];
    plant.motor_friction_minus += p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(motor_coulomb_friction, MotorCoulombFriction)
