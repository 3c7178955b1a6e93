// torque_saturation – a smooth loss of torque at large inputs.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"
#include "plant/effects/smooth_functions.h"

namespace gapscope::internal::plant {
namespace {

struct TorqueSaturation {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law = "u/(1 + |u/knee|^s)^(1/s) in place of u";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"knee", "unit of u", std::numeric_limits<double>::infinity(), 0.1, 20.0, Scale::kPeakInput},
      {"sharpness", "-", 2.0, 1.0, 100.0, Scale::kOne}};
  static constexpr std::array<const char*, 1> look_alikes = {"quadratic_drag"};
  static constexpr ResidualPattern follows = ResidualPattern::kInput;
  static constexpr EffectStart starts[] = {{1.0, 3.0}, {2.5, 3.0}};

  template <class T>
  static T command(const T& u, const T* p) {
    if (value_of(u) == 0.0 || !std::isfinite(value_of(p[0]))) return u;
    const T size = value_of(u) < 0.0 ? T(-u) : u;
    return u / power(T(1.0 + power(T(size / p[0]), p[1])), T(1.0 / p[1]));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(torque_saturation, TorqueSaturation)
