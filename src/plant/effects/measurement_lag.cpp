// measurement_lag – the measured angle passes a first-order filter.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct MeasurementLag {
  static constexpr EffectSide side = EffectSide::kSensor;
  static constexpr const char* law = "tau dy/dt = x1 - y, y is measured";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"time_constant_s", "s", 0.0, 0.0, 100.0, Scale::kSample}};
  static constexpr std::array<const char*, 2> look_alikes = {"input_delay", "actuator_lag"};
  static constexpr ResidualPattern follows = ResidualPattern::kInputSteps;
  static constexpr EffectStart starts[] = {{0.7}, {3.0}, {10.0}};

  // Memory: y − x1. Over a smooth step x1 is the cubic through both ends, for which the filter is solved
  // exactly: for x1 = Σ a_n sⁿ the forced part of y is the polynomial Σ b_n sⁿ with b_3 = a_3, b_n = a_n − (n
  // + 1) τ b_{n+1}.
  template <class T>
  static T sense(const EffectPoint<T>& at, const T* p) {
    return value_of(p[0]) > 0.0 ? at.memory[0] : T(0.0);
  }

  template <class T>
  static void remember(const EffectPoint<T>&, T* memory, const T*) {
    memory[0] = T(0.0);
  }

  template <class T>
  static void advance(const EffectPoint<T>& from, const EffectPoint<T>& to, T* memory, const T* p) {
    using std::exp;
    const T& tau = p[0];
    if (value_of(tau) <= 0.0) return;
    const T h = to.time - from.time;
    if (value_of(h) <= 0.0) return;
    const T dx = to.state.x1 - from.state.x1;
    const T a1 = from.state.w1;
    const T a2 = (3.0 * dx / h - 2.0 * from.state.w1 - to.state.w1) / h;
    const T a3 = (from.state.w1 + to.state.w1 - 2.0 * dx / h) / (h * h);
    const T b3 = a3, b2 = a2 - 3.0 * tau * b3, b1 = a1 - 2.0 * tau * b2, b0 = -tau * b1;
    const T end = b0 + h * (b1 + h * (b2 + h * b3)) - dx;  // forced part, relative to x1 at the end
    memory[0] = end + (memory[0] - b0) * exp(-h / tau);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(measurement_lag, MeasurementLag)
