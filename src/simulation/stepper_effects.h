#pragma once

#include "simulation/stepper_impl.h"

namespace gapscope::internal::simulation {

template <class T>
EffectPoint<T> StepperImpl<T>::point(const DriveState<T>& state, const T& time, std::size_t effect) const {
  const int direction = motor_friction ? mode.motor : direction_of(value_of(state.w1));
  return {state, z, now, time, torque, direction, model, memory.data() + effect * kMostEffectMemory};
}

/// The amplitude now of the torque that dies away.
template <class T>
T StepperImpl<T>::dying_torque() const {
  const auto effect = static_cast<std::size_t>(decaying);
  const auto& e = model.effects[effect];
  return decay_share * e.hooks->decay(point(z, now, effect), e.parameters).amplitude;
}

/// What the contact's torque is beyond k p + c ṗ at a penetration p that grows with a speed.
template <class T>
T StepperImpl<T>::beyond_spring(const T& penetration, const T& speed) const {
  T sum(0.0);
  if (!f.hardens) return sum;
  for (const ActiveEffect<T>& e : model.effects)
    if (e.hooks->contact != nullptr) sum += e.hooks->contact(penetration, speed, model, e.parameters);
  return sum;
}

/// Of one inertia, which counts as the load's: its gears carry what the motor's torque X, after the motor's
/// dampers and constant friction, leaves of itself, τ = X − s μ |τ| = X/(1 + s sign(X) μ).
template <class T>
T StepperImpl<T>::rubbed_off(const DriveState<T>& state, const T& time, const T& extra) const {
  const double s = mode.motor;
  T applied = torque + extra - (s < 0.0 ? f.d1_minus : f.d1_plus) * state.w1 - s * motor_level(mode.motor);
  applied -= model.load_torque;  // which stands in the torque of one inertia
  using std::exp;
  if (decaying >= 0) applied += dying_torque() * exp(-f.decay_rate * (time - now));
  const T share = s * direction_of(value_of(applied)) * f.gear_friction;
  return applied * share / (1.0 + share);
}

template <class T>
Extra<T> StepperImpl<T>::extra_at(const DriveState<T>& state, const T& time) const {
  Extra<T> sum;
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const ActiveEffect<T>& e = model.effects[i];
    if (e.hooks->torque != nullptr) {
      const DriveTorque<T> added = e.hooks->torque(point(state, time, i), e.parameters);
      sum.motor += added.motor;
      sum.load += added.load;
    }
    if (e.hooks->half_gap != nullptr) sum.half_gap += e.hooks->half_gap(point(state, time, i), e.parameters);
  }
  const int side = mode.contact != 0 ? mode.contact : mode.outside;
  if (f.hardens && side != 0)
    sum.contact = beyond_spring(state.x1 - state.x2 - static_cast<double>(side) * (half_gap + sum.half_gap),
                                state.w1 - state.w2);
  if (has_load) return sum;
  sum.motor += sum.load;
  if (model.gears_rub && mode.motor != 0) sum.motor -= rubbed_off(state, time, sum.motor - sum.load);
  return sum;
}

/// Out of line, as GCC would have it, it costs a plain drive 6 % of its samples.
template <class T>
[[gnu::always_inline]] inline Forcing<T> StepperImpl<T>::forcing_without_effects() const {
  Forcing<T> on;
  on.motor[0] = torque;
  if (motor_friction && mode.motor != 0)
    on.motor[0] -= static_cast<double>(mode.motor) * motor_level(mode.motor);
  on.load[0] = model.load_torque;
  if (load_friction) on.load[0] -= static_cast<double>(mode.load) * model.drive.load_coulomb_friction;
  on.half_gap[0] = half_gap;
  if (decaying >= 0) on.decaying = dying_torque();
  return on;
}

template <class T>
void add_constant(Forcing<T>& on, const Extra<T>& extra) {
  on.motor[0] += extra.motor;
  on.load[0] += extra.load;
  on.half_gap[0] += extra.half_gap;
  on.contact[0] = extra.contact;
}

template <class T>
Forcing<T> StepperImpl<T>::forcing_now() const {
  Forcing<T> on = forcing_without_effects();
  if (smooth) add_constant(on, extra_at(z, now));
  return on;
}

/// Slope and curvature of the quadratic through three equally spaced values, 1/inverse_h from end to end.
template <class T>
void quadratic(T (&c)[3], const T& start, const T& middle, const T& end, const T& inverse_h) {
  c[1] = (4.0 * middle - 3.0 * start - end) * inverse_h;
  c[2] = 2.0 * (start - 2.0 * middle + end) * (inverse_h * inverse_h);
}

template <class T>
void StepperImpl<T>::bend(Forcing<T>& on, const Extra<T>& start, const Extra<T>& middle, const Extra<T>& end,
                          const T& inverse_h) const {
  if (adds_torque) {
    quadratic(on.motor, start.motor, middle.motor, end.motor, inverse_h);
    if (has_load) quadratic(on.load, start.load, middle.load, end.load, inverse_h);
  }
  if (moves_gap) quadratic(on.half_gap, start.half_gap, middle.half_gap, end.half_gap, inverse_h);
  if (f.hardens) quadratic(on.contact, start.contact, middle.contact, end.contact, inverse_h);
}

template <class T>
double StepperImpl<T>::effect_rate() const {
  double rate = 0.0;
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const ActiveEffect<T>& e = model.effects[i];
    if (e.hooks->contact != nullptr && mode.contact == 0 && mode.outside == 0) continue;
    if (e.hooks->rate != nullptr) rate = std::max(rate, e.hooks->rate(point(z, now, i), e.parameters));
  }
  return std::min(rate, (1 << kMostHalvings) * kEffectReach / dt);
}

template <class T>
void StepperImpl<T>::remember_start() {
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const ActiveEffect<T>& e = model.effects[i];
    if (e.hooks->remember == nullptr) continue;
    const DriveState<T> seen = seen_by(e, z);
    e.hooks->remember(point(seen, now, i), memory.data() + i * kMostEffectMemory, e.parameters);
  }
}

template <class T>
void StepperImpl<T>::advance_memory(const DriveState<T>& to, const T& end_time) {
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const ActiveEffect<T>& e = model.effects[i];
    if (e.hooks->advance == nullptr) continue;
    const DriveState<T> from = seen_by(e, z), next = seen_by(e, to);
    e.hooks->advance(point(from, now, i), point(next, end_time, i), memory.data() + i * kMostEffectMemory,
                     e.parameters);
  }
}

template <class T>
void StepperImpl<T>::set_input(const T& u) {
  T input = u;
  for (const ActiveEffect<T>& e : model.effects)
    if (e.hooks->command != nullptr) input = e.hooks->command(input, e.parameters);
  torque = model.drive.torque_constant * input;
  if (!has_load) torque += model.load_torque;
}

/// The inertia of the middle of a span; the precomputed transitions hold as long as it stays.
template <class T>
void StepperImpl<T>::set_inertia(double span) {
  T factor(1.0);
  for (const ActiveEffect<T>& e : model.effects)
    if (e.hooks->load_inertia != nullptr) factor *= e.hooks->load_inertia(now + 0.5 * span, e.parameters);
  bool same = value_of(factor) == value_of(inertia_factor);
  if constexpr (kIsJet<T>) same = same && factor.v == inertia_factor.v;
  if (same) return;
  inertia_factor = factor;
  const DriveParameters<T>& p = model.drive;
  if (has_load)
    f.m2 = p.motor_inertia * p.mass_ratio * factor;
  else
    f.m1 = p.motor_inertia * factor;
  inverse_m1 = 1.0 / value_of(f.m1), inverse_m2 = 1.0 / value_of(f.m2);
  for (auto& of_segment : transitions)
    for (auto& of_mode : of_segment)
      for (StateTransition<T>& t : of_mode) t.ready = false;
}

}  // namespace gapscope::internal::simulation
