// load_dependent_friction – friction of the gears, which grows with the torque that they carry.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct LoadDependentFriction {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law =
      "motor torque -(Fc1 + mu |tau_g|) sign(w1), set-valued at rest; tau_g the contact torque, without a "
      "contact that which moves the one inertia against the torques of the load";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque},
      {"ratio", "-", 0.0, 0.0, 0.9, Scale::kOne, false, "of the torque that goes to the load"}};
  static constexpr std::array<const char*, 2> look_alikes = {"motor_coulomb_friction", "torque_saturation"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr const char* contains = "motor_coulomb_friction";
  static constexpr EffectStart starts[] = {{0.01, 0.1}, {0.03, 0.3}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.motor_sticks = plant.gears_rub = true;
    plant.motor_friction_plus += p[0];
    plant.motor_friction_minus += p[0];
    plant.gear_friction += p[1];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(load_dependent_friction, LoadDependentFriction)
