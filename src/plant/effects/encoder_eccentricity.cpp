// encoder_eccentricity – the code disc is off centre.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct EncoderEccentricity {
  static constexpr EffectSide side = EffectSide::kSensor;
  static constexpr const char* law = "x1 + e sin(N x1 + phase) is measured";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"amplitude_rad", "rad", 0.0, 0.0, 0.1, Scale::kTravel},
      {"phase_rad", "rad", 0.0, -7.0, 7.0, Scale::kOne},
      {"periods_per_turn", "1/rev", 1.0, 0.02, 100.0, Scale::kPerTravel, true}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kAngle;
  static constexpr Shaft turns_with = Shaft::kMotor;
  static constexpr StartSearch start_search = StartSearch::kSine;
  static constexpr auto starts = quarters({0.002, 0.02});

  template <class T>
  static T sense(const EffectPoint<T>& at, const T* p) {
    using std::sin;
    return p[0] * sin(p[2] * at.state.x1 + p[1]);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(encoder_eccentricity, EncoderEccentricity)
