#pragma once

#include "simulation/stepper_impl.h"

namespace gapscope::internal::simulation {

template <class T>
StepperImpl<T>::StepperImpl(const PlantModel<T>& m, double step, double shortest) : model(m), dt(step) {
  const DriveParameters<T>& p = m.drive;
  has_load = m.structure.has_load;
  reads_load = m.structure.reads_load();
  locked = has_load && m.structure.load == LoadKind::kLocked;
  load_friction = has_load && !locked && m.load_sticks;
  motor_friction = m.motor_sticks;
  // A free-form law may take more than there is at rest: friction never drives.
  for (T* level : {&model.motor_friction_plus, &model.motor_friction_minus})
    if (value_of(*level) < 0.0) *level = T(0.0);
  GAPSCOPE_REQUIRE(step > 0.0);
  GAPSCOPE_REQUIRE(value_of(p.motor_inertia) > 0.0);
  GAPSCOPE_REQUIRE(!has_load || locked || value_of(p.mass_ratio) > 0.0);
  f.m1 = p.motor_inertia;
  f.m2 = has_load && !locked ? T(p.motor_inertia * p.mass_ratio) : T(p.motor_inertia);
  f.d1_plus = p.motor_damping + m.motor_damping_excess;
  f.d1_minus = p.motor_damping - m.motor_damping_excess;
  f.d2 = has_load && !locked ? p.load_damping : T(0.0);
  f.k = p.contact_stiffness;
  f.c = p.contact_damping;
  f.gear_friction = m.gear_friction;
  f.rubs = m.gears_rub;
  f.rigid = m.structure.contact == ContactLaw::kRigid;
  half_gap = 0.5 * p.gap;
  adds_torque = smooth = m.gears_rub && !has_load;
  inverse_m1 = 1.0 / value_of(f.m1), inverse_m2 = 1.0 / value_of(f.m2);
  for (const ActiveEffect<T>& e : m.effects) {
    adds_torque = adds_torque || e.hooks->torque != nullptr;
    moves_gap = moves_gap || e.hooks->half_gap != nullptr;
    f.hardens = f.hardens || (e.hooks->contact != nullptr && has_load && !f.rigid);
    smooth = smooth || adds_torque || moves_gap || f.hardens;
    remembers = remembers || e.hooks->advance != nullptr;
    varies_inertia = varies_inertia || e.hooks->load_inertia != nullptr;
    if (e.hooks->decay != nullptr) decaying = static_cast<int>(&e - m.effects.data());
    if (e.hooks->delay == nullptr) continue;
    delay += e.hooks->delay(e.parameters);
    delayed = true;
  }
  const double whole = std::floor(value_of(delay) / dt);
  delay_rest = delay - whole * dt;
  inputs.assign(static_cast<std::size_t>(whole) + 2, T(0.0));
  if (shortest > 0.0) {
    inputs.assign(static_cast<std::size_t>(value_of(delay) / std::max(shortest, kShortestStep * dt)) + 3,
                  T(0.0));
    given.assign(inputs.size(), 0.0);
  }
  memory.assign(m.effects.size() * kMostEffectMemory, T(0.0));
  set_decay();
  reset({});
}

/// A torque that dies within a small part of a sample is replaced by a slower one of the same impulse.
template <class T>
void StepperImpl<T>::set_decay() {
  if (decaying < 0) return;
  const auto effect = static_cast<std::size_t>(decaying);
  const auto& e = model.effects[effect];
  f.decay_rate = e.hooks->decay(point(z, now, effect), e.parameters).rate;
  const double most = kMostDecayPieces * kSeriesReach / dt;
  if (value_of(f.decay_rate) <= most) return;
  decay_share = most / f.decay_rate;
  f.decay_rate = T(most);
}

template <class T>
void StepperImpl<T>::reset(const DriveState<T>& state) {
  z = state;
  mode = {};
  now = T(0.0);
  torque = T(0.0);
  started = closed = false;
  healthy = true;
  events = smooth_pieces = 0;
  forget_zeros();
  if (locked) z.w2 = T(0.0);
  if (motor_friction) mode.motor = direction_of(value_of(z.w1));
  if (locked || load_friction) mode.load = direction_of(value_of(z.w2));
  remember_start();
  if (!f.rigid) resolve_contact();
  if (load_friction && mode.load == 0) resolve_load();
}

template <class T>
void StepperImpl<T>::inject(const T& dx, const T& dw) {
  if (!reads_load || mode.contact != 0) {
    z.x1 += dx;
    if (mode.motor != 0) z.w1 += dw;
  }
  if (reads_load || mode.contact != 0) {
    if (!locked) z.x2 += dx;
    if (mode.load != 0) z.w2 += dw;
  }
  if (motor_friction && mode.motor != 0 && mode.motor * value_of(z.w1) < 0.0) mode.motor = -mode.motor;
  if (load_friction && mode.load != 0 && mode.load * value_of(z.w2) < 0.0) mode.load = -mode.load;
  forget_zeros();
  if (!f.rigid) resolve_contact();
}

template <class T>
T StepperImpl<T>::measured() const {
  T position = reads_load ? z.x2 : z.x1;
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const ActiveEffect<T>& e = model.effects[i];
    if (e.hooks->sense == nullptr) continue;
    const DriveState<T> seen = seen_by(e, z);
    position += e.hooks->sense(point(seen, now, i), e.parameters);
  }
  return position;
}

/// A sensor sees the body that it is on: laws of sensors call that one x1.
template <class T>
DriveState<T> StepperImpl<T>::seen_by(const ActiveEffect<T>& effect, const DriveState<T>& state) const {
  if (!reads_load || effect.hooks->sense == nullptr) return state;
  return {state.x2, state.w2, state.x1, state.w1};
}

template <class T>
double StepperImpl<T>::side_distance(int side) const {
  return side * (value_of(z.x1) - value_of(z.x2)) - value_of(forcing_now().half_gap[0]);
}

template <class T>
T StepperImpl<T>::contact_torque(int side) const {
  const Forcing<T> on = forcing_now();
  if (!f.rigid) {
    const T penetration = z.x1 - z.x2 - static_cast<double>(side) * on.half_gap[0];
    const T speed = z.w1 - z.w2;
    return f.k * penetration + f.c * speed + beyond_spring(penetration, speed);
  }
  if (mode.load == 0 || mode.motor == 0) return motor_coefficient(on, 0);
  const T motor = motor_coefficient(on, 0) - (mode.motor < 0 ? f.d1_minus : f.d1_plus) * z.w1;
  const T felt = felt_share(f, mode);
  return (motor - f.m1 * ((motor + felt * (on.load[0] - f.d2 * z.w1)) / (f.m1 + felt * f.m2))) / felt;
}

template <class T>
T StepperImpl<T>::breaking_level(int direction, const Forcing<T>& on) const {
  using std::abs;
  T level = motor_level(direction);
  if (!model.gears_rub) return level;
  if (!has_load) return level + f.gear_friction * abs(on.load[0]);
  if (!f.rigid) return level + f.gear_friction * abs(acting_torque());
  // Bonded to a load that its own friction holds: what that and its torque ask of the gears.
  const T friction = load_friction ? model.drive.load_coulomb_friction : T(0.0);
  return level + f.gear_friction * abs(friction - static_cast<double>(direction) * on.load[0]);
}

}  // namespace gapscope::internal::simulation
