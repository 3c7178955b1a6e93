// gap_eccentricity – the gap changes with the angle of the load.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct GapEccentricity {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law = "gap 2 beta + 2 b sin(N x2 + phase)";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"amplitude_rad", "rad", 0.0, 0.0, 0.475, Scale::kGap},
      {"phase_rad", "rad", 0.0, -7.0, 7.0, Scale::kOne},
      {"periods_per_turn", "1/rev", 1.0, 0.02, 5.0, Scale::kPerTravel, true}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kAngle;
  static constexpr Shaft turns_with = Shaft::kLoad;
  static constexpr EffectNeeds needs = EffectNeeds::kGap;
  static constexpr StartSearch start_search = StartSearch::kSine;
  static constexpr auto starts = quarters({0.15});

  template <class T>
  static T half_gap(const EffectPoint<T>& at, const T* p) {
    using std::sin;
    return p[0] * sin(p[2] * at.state.x2 + p[1]);
  }

  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    return std::abs(value_of(p[2]) * value_of(at.state.w2));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(gap_eccentricity, GapEccentricity)
