// encoder_quantization – the encoder is coarser than its sheet.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct EncoderQuantization {
  static constexpr EffectSide side = EffectSide::kSensor;
  static constexpr const char* law = "x1 is rounded to multiples of the quantum";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"quantum_rad", "rad", 0.0, 0.0, 1024.0, Scale::kQuantum}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kCounts;

  template <class T>
  static double quantum(const T* p) {
    return value_of(p[0]);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(encoder_quantization, EncoderQuantization)
