// input_delay – the input acts later, by any fraction of a sample.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct InputDelay {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law = "u(t - delay) in place of u(t)";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"delay_s", "s", 0.0, 0.0, 50.0, Scale::kSample}};
  static constexpr std::array<const char*, 2> look_alikes = {"actuator_lag", "measurement_lag"};
  static constexpr ResidualPattern follows = ResidualPattern::kInputSteps;
  static constexpr EffectStart starts[] = {{0.7}, {3.0}, {10.0}};

  template <class T>
  static T delay(const T* p) {
    return p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(input_delay, InputDelay)
