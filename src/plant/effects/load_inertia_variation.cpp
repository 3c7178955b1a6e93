// load_inertia_variation – the load inertia changes during the recording.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct LoadInertiaVariation {
  static constexpr EffectSide side = EffectSide::kLoad;
  static constexpr const char* law = "m2 (1 + ratio S((t - time)/duration)), S a smooth step from 0 to 1";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"ratio", "-", 0.0, -0.95, 10.0, Scale::kOne, false, "of the load's inertia"},
      {"time_s", "s", 0.5, 0.0, 1.0, Scale::kRecord},
      {"duration_s", "s", 0.1, 0.0, 1.0, Scale::kRecord}};
  static constexpr std::array<const char*, 1> look_alikes = {"viscous_drift"};
  static constexpr ResidualPattern follows = ResidualPattern::kTime;
  static constexpr EffectNeeds needs = EffectNeeds::kFreeLoad;
  static constexpr EffectStart starts[] = {
      {0.4, 0.25, 0.15}, {0.4, 0.4, 0.15}, {0.4, 0.6, 0.15}, {-0.3, 0.4, 0.15}};

  template <class T>
  static T load_inertia(const T& time, const T* p) {
    if (value_of(time) <= value_of(p[1])) return T(1.0);
    if (value_of(time) >= value_of(p[1]) + value_of(p[2])) return 1.0 + p[0];
    const T s = (time - p[1]) / p[2];
    return 1.0 + p[0] * s * s * (3.0 - 2.0 * s);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(load_inertia_variation, LoadInertiaVariation)
