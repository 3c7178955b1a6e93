// load_resonance – a further inertia on the load, behind a spring.
#include <array>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct LoadResonance {
  static constexpr EffectSide side = EffectSide::kLoad;
  static constexpr const char* law =
      "load torque m3 (w0^2 (x3 - x2) + 2 D w0 (w3 - w2)), which moves m3 = ratio m2 back against its own friction "
      "damping w3 + level sign(w3); w0 = 2 pi f";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"inertia_ratio", "-", 0.0, 0.0, 5.0, Scale::kOne, false, "of the load's inertia"},
      {"frequency_hz", "Hz", 30.0, 1.0, 5000.0, Scale::kPerRecord},
      {"damping_ratio", "-", 0.05, 0.0, 1.0, Scale::kOne},
      {"damping_nms", "N m s/rad", 0.0, 0.0, 1.0, Scale::kTorquePerSpeed, true},
      {"level_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque, true}};
  static constexpr std::array<const char*, 2> look_alikes = {"shaft_compliance", "input_delay"};
  static constexpr ResidualPattern follows = ResidualPattern::kInputSteps;
  static constexpr EffectNeeds needs = EffectNeeds::kFreeLoad;
  /// Steps of 1.3 in frequency: of seven drives that steps of 1.75 had missed, they find five.
  static constexpr EffectStart starts[] = {
      {0.2, 60.0, 0.05},  {0.2, 12.0, 0.05},  {0.2, 16.0, 0.05},  {0.2, 20.0, 0.05},  {0.2, 26.0, 0.05},
      {0.2, 34.0, 0.05},  {0.2, 45.0, 0.05},  {0.2, 58.0, 0.05},  {0.2, 75.0, 0.05},  {0.2, 98.0, 0.05},
      {0.2, 127.0, 0.05}, {0.2, 165.0, 0.05}, {0.2, 215.0, 0.05}, {0.2, 280.0, 0.05}, {0.2, 363.0, 0.05},
      {0.2, 472.0, 0.05}, {0.2, 614.0, 0.05}, {0.2, 798.0, 0.05}, {0.2, 1038.0, 0.05}};

  static constexpr int kOrder = 10;  ///< of the series: its rest is 3e-13 of the speed at w0 h = 1/4
  static constexpr double kOver[kOrder + 1] = {0.0,     1.0,     1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5,
                                               1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10};

  static constexpr double kTight = 2.0;  ///< rate at which dry friction stops the further inertia [w0]

  template <class T>
  struct Body {
    T x, w;
  };

  template <class T>
  static T carried(const PlantModel<T>& plant) {
    const DriveParameters<T>& d = plant.drive;
    return plant.structure.has_load ? T(d.motor_inertia * d.mass_ratio) : d.motor_inertia;
  }

  /// What its own friction takes off its acceleration at this speed: dry friction grows with the speed until
  /// it has its level.
  template <class T>
  static T friction(const PlantModel<T>& plant, const T& speed, const T* p) {
    if (value_of(p[0]) <= 0.0) return T(0.0);
    const T most = p[4] / (p[0] * carried(plant)), slow = kTight * 2.0 * kPi * p[1] * speed;
    if (value_of(slow) > value_of(most)) return most;
    if (value_of(slow) < -value_of(most)) return -most;
    return value_of(most) > 0.0 ? slow : T(0.0);
  }
  template <class T>
  static T drag(const PlantModel<T>& plant, const T* p) {
    return value_of(p[0]) <= 0.0 ? T(0.0) : T(p[3] / (p[0] * carried(plant)));
  }

  template <class T>
  static Body<T> carrier(const DriveState<T>& state, const PlantModel<T>& plant) {
    return plant.structure.has_load ? Body<T>{state.x2, state.w2} : Body<T>{state.x1, state.w1};
  }

  /// The further inertia against its carrier, whose motion is the cubic through both ends of the step: a
  /// power series in the share of the step that has passed.   Memory: x3, w3.
  template <class T>
  static Body<T> apart(const EffectPoint<T>& at, const T* memory, const T* p) {
    const T h = at.time - at.start_time;
    const Body<T> from = carrier(at.start, at.plant), to = carrier(at.state, at.plant);
    T z = memory[0] - from.x;
    if (value_of(h) <= 0.0) return {z, memory[1] - from.w};
    T slope = (memory[1] - from.w) * h;
    const T way = to.x - from.x;
    const T base[] = {3.0 * way - (2.0 * from.w + to.w) * h, (from.w + to.w) * h - 2.0 * way};
    const T angle = 2.0 * kPi * p[1] * h, pull = angle * angle;
    const T own = drag(at.plant, p) * h, damp = 2.0 * p[2] * angle + own;
    // Dry friction over the step is that of the speed in the middle of it.
    const T begun = pull * z + 2.0 * p[2] * angle * slope + own * h * memory[1];
    const T turned = begun + friction(at.plant, memory[1], p) * h * h;
    const T rub = friction(at.plant, T(memory[1] - 0.5 * turned / h), p);
    // Its friction, of the carrier's speed and of the dry level, in powers of the share of the step.
    const T push[] = {own * from.w * h + rub * h * h, 2.0 * own * base[0], 3.0 * own * base[1]};
    T place = z + slope, speed = slope;
    for (int n = 0; n + 2 <= kOrder; ++n) {
      T next = (pull * z * kOver[n + 1] + damp * slope) * -kOver[n + 2];
      if (n < 2) next -= base[n];
      if (n < 3) next -= push[n] * kOver[n + 1] * kOver[n + 2];
      place += next, speed += (n + 2.0) * next;
      z = slope, slope = next;
    }
    return {place, speed / h};
  }

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const Body<T> z = apart(at, at.memory, p);
    const T rate = 2.0 * kPi * p[1];
    return {.load = p[0] * carried(at.plant) * rate * (rate * z.x + 2.0 * p[2] * z.w)};
  }

  /// It begins with its carrier, and without a load where a rigid shaft would need the spring to be.
  template <class T>
  static void remember(const EffectPoint<T>& start, T* memory, const T* p) {
    const Body<T> on = carrier(start.state, start.plant);
    memory[0] = on.x, memory[1] = on.w;
    if (start.plant.structure.has_load) return;
    const T inertia = start.plant.drive.motor_inertia, rate = 2.0 * kPi * p[1];
    const T own = drag(start.plant, p) * on.w + friction(start.plant, on.w, p);
    const T left = start.drive_torque - start.plant.drive.motor_damping * on.w - p[0] * inertia * own;
    memory[0] -= (left / (inertia * (1.0 + p[0])) + own) / (rate * rate);
  }

  template <class T>
  static void advance(const EffectPoint<T>&, const EffectPoint<T>& to, T* memory, const T* p) {
    const Body<T> z = apart(to, memory, p), on = carrier(to.state, to.plant);
    memory[0] = on.x + z.x, memory[1] = on.w + z.w;
  }

  /// Both inertias against each other swing faster than the further one on a held load.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const double dry = value_of(p[4]) > 0.0 ? kTight : 0.0;
    return 2.0 * kPi * value_of(p[1]) * (std::sqrt(1.0 + value_of(p[0])) + 2.0 * value_of(p[2]) + dry) +
           value_of(drag(at.plant, p));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(load_resonance, LoadResonance)
