// input_curve – law of last resort: the input that acts is any function of the one that is given.
#include <array>

#include "plant/effects/define_effect.h"
#include "plant/effects/node_curve.h"

namespace gapscope::internal::plant {
namespace {

/// What it adds is zero at no input, where it would be a constant torque. What both directions have in common
/// ends in zero at the largest input: what grows with the input throughout is the torque constant. Amplifiers
/// and motors that differ by direction, saturate or have a dead zone all go on straight beyond the inputs
/// seen.
struct InputCurve {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law =
      "u + s G(|u|) in place of u, s = sign(u); G is the natural cubic spline through change_k + s skew_k "
      "at (k/7)^2 peak_input, 0 at rest, change_7 = 0, and goes on straight from there";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"peak_input", "unit of u", 1.0, 1.0, 1.0, Scale::kPeakInput},
      {"change_1", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"change_2", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"change_3", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"change_4", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"change_5", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"change_6", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_1", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_2", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_3", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_4", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_5", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_6", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput},
      {"skew_7", "unit of u", 0.0, -1.0, 1.0, Scale::kPeakInput}};
  static constexpr std::array<const char*, 2> look_alikes = {"input_dead_zone", "torque_saturation"};
  static constexpr ResidualPattern follows = ResidualPattern::kInput;
  static constexpr int kNodes = 7;

  template <class T>
  static T command(const T& u, const T* p) {
    const double s = value_of(u) < 0.0 ? -1.0 : 1.0;
    const T size = s * u / p[0];
    return u + s * along_nodes<kNodes, Beyond::kStraight>(size, [&](int k) {
                 if (k == 0) return T(0.0);
                 const T skew = s * p[kNodes - 1 + k];
                 return k < kNodes ? T(p[k] + skew) : skew;
               });
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(input_curve, InputCurve)
