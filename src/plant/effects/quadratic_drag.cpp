// quadratic_drag – drag of the motor side that grows with the square of the speed.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal {
namespace {

struct QuadraticDrag {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "motor torque -b w1 |w1|";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"coefficient_nms2", "N m s^2/rad^2", 0.0, 0.0, 2.0, Scale::kTorquePerSpeed2}};
  static constexpr std::array<const char*, 2> look_alikes = {"torque_saturation", "stribeck_friction"};

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const T& w1 = at.state.w1;
    return {.motor = -p[0] * w1 * (value_of(w1) < 0.0 ? -w1 : w1)};
  }
};

}  // namespace
}  // namespace gapscope::internal

GAPSCOPE_DEFINE_EFFECT(quadratic_drag, QuadraticDrag)
