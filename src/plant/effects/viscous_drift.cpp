// viscous_drift – viscous friction of the motor grows or falls as it warms up.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ViscousDrift {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "d1 (1 + ratio (1 - exp(-t/tau)))";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"ratio", "-", 0.0, -0.98, 5.0, Scale::kOne, false, "of the damping"},
      {"time_constant_s", "s", 0.3, 0.01, 10.0, Scale::kRecord}};
  static constexpr std::array<const char*, 1> look_alikes = {"load_inertia_variation"};
  static constexpr ResidualPattern follows = ResidualPattern::kTime;
  static constexpr EffectStart starts[] = {{0.4, 0.4}, {-0.3, 0.4}};

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    using std::exp;
    const T grown = p[0] * (1.0 - exp(-at.time / p[1]));
    return {.motor = -at.plant.drive.motor_damping * grown * at.state.w1};
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(viscous_drift, ViscousDrift)
