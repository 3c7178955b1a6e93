// torque_ripple – the torque constant repeats with the angle of the motor.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"
#include "plant/effects/smooth_functions.h"

namespace gapscope::internal::plant {
namespace {

struct TorqueRipple {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law =
      "torque of the input times 1 + s (sin(y) + h2 sin(2 y) + g2 cos(2 y) + h3 sin(3 y) + g3 cos(3 y)), "
      "y = N x1 + phase";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"ratio", "-", 0.0, 0.0, 0.95, Scale::kOne, false, "of the motor's torque (amplitude)"},
      {"periods_per_turn", "1/rev", 2.0, 0.25, 2000.0, Scale::kPerTravel},
      {"phase_rad", "rad", 0.0, -7.0, 7.0, Scale::kOne},
      {"second_harmonic", "-", 0.0, -0.5, 0.5, Scale::kOne},
      {"second_harmonic_cos", "-", 0.0, -0.5, 0.5, Scale::kOne, true},
      {"third_harmonic", "-", 0.0, -0.5, 0.5, Scale::kOne, true},
      {"third_harmonic_cos", "-", 0.0, -0.5, 0.5, Scale::kOne, true}};
  static constexpr std::array<const char*, 1> look_alikes = {"cogging_torque"};
  static constexpr ResidualPattern follows = ResidualPattern::kAngle;
  static constexpr StartSearch start_search = StartSearch::kTorqueShareLines;

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    return {.motor = at.drive_torque * p[0] * three_harmonics(T(p[1] * at.state.x1 + p[2]), p + 3)};
  }

  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    return std::abs(value_of(p[1]) * value_of(at.state.w1)) * harmonics_rate(p + 3);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(torque_ripple, TorqueRipple)
