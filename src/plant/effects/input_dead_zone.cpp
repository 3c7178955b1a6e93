// input_dead_zone – small inputs give no torque; the threshold is missing beyond.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct InputDeadZone {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law = "u less its part within +-width in place of u";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"width", "unit of u", 0.0, 0.0, 0.95, Scale::kPeakInput}};
  static constexpr std::array<const char*, 1> look_alikes = {"motor_coulomb_friction"};
  static constexpr ResidualPattern follows = ResidualPattern::kInput;
  static constexpr EffectStart starts[] = {{0.03}, {0.12}};

  template <class T>
  static T command(const T& u, const T* p) {
    if (value_of(u) > value_of(p[0])) return u - p[0];
    if (value_of(u) < -value_of(p[0])) return u + p[0];
    return T(0.0);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(input_dead_zone, InputDeadZone)
