// quadratic_drag – drag of the motor side that grows with the square of the speed.
#include <array>

#include "plant/effects/define_effect.h"
#include "plant/effects/smooth_functions.h"

namespace gapscope::internal::plant {
namespace {

struct QuadraticDrag {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law = "motor torque -b w1 |w1| |w1/(1 rad/s)|^(n - 2)";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"coefficient_nms2", "N m s^2/rad^2", 0.0, 0.0, 2.0, Scale::kTorquePerSpeed2},
      {"exponent", "-", 2.0, 1.5, 2.5, Scale::kOne}};
  static constexpr std::array<const char*, 2> look_alikes = {"torque_saturation", "stribeck_friction"};
  static constexpr ResidualPattern follows = ResidualPattern::kSpeed;
  static constexpr EffectStart starts[] = {{0.1, 2.0}, {0.4, 2.0}};

  /// A power has no derivative by its exponent at rest.
  static constexpr double kRounding = 1e-12;  // (rad/s)²

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const T& w1 = at.state.w1;
    return {.motor = -p[0] * w1 * power(T(w1 * w1 + kRounding), T(0.5 * (p[1] - 1.0)))};
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(quadratic_drag, QuadraticDrag)
