// gap_growth – the gap drifts over the recording, through wear or heat.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct GapGrowth {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law = "gap 2 beta + rate t";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"rate_rad_s", "rad/s", 0.0, -0.95, 10.0, Scale::kGapPerRecord}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kTime;
  static constexpr EffectNeeds needs = EffectNeeds::kGap;
  static constexpr EffectStart starts[] = {{0.3}, {-0.3}};

  template <class T>
  static T half_gap(const EffectPoint<T>& at, const T* p) {
    return 0.5 * p[0] * at.time;
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(gap_growth, GapGrowth)
