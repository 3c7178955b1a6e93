// actuator_lag – the torque follows the input through a first-order loop.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ActuatorLag {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law = "tau dq/dt = u - q, torque of q in place of u";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"time_constant_s", "s", 0.0, 0.0, 100.0, Scale::kSample}};
  static constexpr std::array<const char*, 2> look_alikes = {"input_delay", "measurement_lag"};
  static constexpr ResidualPattern follows = ResidualPattern::kInputSteps;
  static constexpr EffectStart starts[] = {{0.7}, {3.0}, {10.0}};

  // Within a step of constant u:  q − u = (q0 − u) exp(−(t − t0)/τ), in torques.   Memory: t0, Km q0.
  template <class T>
  static T lacking(const EffectPoint<T>& at, const T* memory, const T* p) {
    using std::exp;
    if (value_of(p[0]) <= 0.0) return T(0.0);
    return (memory[1] - at.drive_torque) * exp(-(at.time - memory[0]) / p[0]);
  }

  template <class T>
  static DecayingTorque<T> decay(const EffectPoint<T>& at, const T* p) {
    if (value_of(p[0]) <= 0.0) return {};
    return {lacking(at, at.memory, p), 1.0 / p[0]};
  }

  template <class T>
  static void remember(const EffectPoint<T>& start, T* memory, const T*) {
    memory[0] = start.time;
    memory[1] = start.drive_torque;  // the input held still before the first sample
  }

  template <class T>
  static void advance(const EffectPoint<T>&, const EffectPoint<T>& to, T* memory, const T* p) {
    memory[1] = to.drive_torque + lacking(to, memory, p);
    memory[0] = to.time;
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(actuator_lag, ActuatorLag)
