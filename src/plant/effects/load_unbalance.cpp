// load_unbalance – gravity on an unbalanced load.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct LoadUnbalance {
  static constexpr EffectSide side = EffectSide::kLoad;
  static constexpr const char* law = "load torque -G sin(N x2 + phase)";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"amplitude_nm", "N m", 0.0, 0.0, 4.0, Scale::kPeakTorque},
      {"phase_rad", "rad", 0.0, -7.0, 7.0, Scale::kOne},
      {"periods_per_turn", "1/rev", 1.0, 0.02, 100.0, Scale::kPerTravel, true}};
  static constexpr std::array<const char*, 2> look_alikes = {"constant_load_torque", "friction_asymmetry"};
  static constexpr ResidualPattern follows = ResidualPattern::kAngle;
  static constexpr Shaft turns_with = Shaft::kLoad;
  static constexpr EffectNeeds needs = EffectNeeds::kFreeLoad;
  static constexpr StartSearch start_search = StartSearch::kSine;
  static constexpr auto starts = quarters({0.08});

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    using std::sin;
    return {.load = -p[0] * sin(p[2] * (at.plant.structure.has_load ? at.state.x2 : at.state.x1) + p[1])};
  }

  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const T& w = at.plant.structure.has_load ? at.state.w2 : at.state.w1;
    return std::abs(value_of(p[2]) * value_of(w));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(load_unbalance, LoadUnbalance)
