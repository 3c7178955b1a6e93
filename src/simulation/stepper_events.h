#pragma once

#include "simulation/stepper_sample.h"

namespace gapscope::internal::simulation {

template <class T>
void StepperImpl<T>::collect(const PowerSeries<T>& series, const Forcing<T>& on, GuardSet& set) const {
  if (has_load) {
    if (mode.contact != 0) {
      set.add(GuardEvent::kOpen, mode.contact, contact_zeros);
    } else if (mode.outside != 0) {
      set.add(GuardEvent::kInside, mode.outside, 0);
      set.add(GuardEvent::kClose, mode.outside, contact_zeros);
    } else {
      for (const int side : {1, -1})
        set.add(GuardEvent::kClose, side, side == touching_side ? contact_zeros : 0);
    }
  }
  if (load_friction) {
    if (mode.load != 0)
      set.add(GuardEvent::kLoadStops, mode.load, load_zeros);
    else if (mode.contact != 0 || smooth)
      for (const int side : {1, -1}) set.add(GuardEvent::kLoadBreaks, side, 0);
  }
  if (motor_friction) {
    if (mode.motor != 0)
      set.add(GuardEvent::kMotorStops, mode.motor, motor_zeros);
    else if (mode.contact != 0 || smooth || decaying >= 0)
      for (const int side : {1, -1}) set.add(GuardEvent::kMotorBreaks, side, 0);
  }
  for (int i = 0; i < set.count; ++i) {
    Guard& guard = set.guards[static_cast<std::size_t>(i)];
    guard.order = series.order;
    with_terms(guard, series, on, [&guard](const auto& term) {
      for (int n = 0; n <= guard.order; ++n) guard.p[n] = value_of(term(n));
    });
  }
}

/// Coefficient n of the torque on the motor without dampers and contact.
template <class T>
T StepperImpl<T>::motor_coefficient(const Forcing<T>& on, int n) const {
  T sum = coefficient(on.motor, n);
  if (decaying < 0) return sum;
  T dying = on.decaying;
  for (int i = 1; i <= n; ++i) dying *= -f.decay_rate / static_cast<double>(i);
  return sum + dying;
}

/// Hands the coefficients of a guard's polynomial, as a function of n, to `use`.
template <class T>
template <class Use>
void StepperImpl<T>::with_terms(const Guard& guard, const PowerSeries<T>& flow, const Forcing<T>& on,
                                const Use& use) const {
  const double side = guard.side;
  const bool touching = mode.contact != 0;
  const auto constant = [](const T& value, int n) { return n == 0 ? value : T(0.0); };
  const auto contact = [&](int n) { return touching ? flow.torque[n] : T(0.0); };
  switch (guard.event) {
    case GuardEvent::kOpen:
      return use([&](int n) { return constant(model.adhesion, n) + side * flow.torque[n]; });
    case GuardEvent::kClose:
      if (mode.outside != 0) return use([&](int n) { return -side * flow.torque[n]; });
      return use([&](int n) { return coefficient(on.half_gap, n) - side * flow.deflection(n); });
    case GuardEvent::kInside:
      return use([&](int n) { return side * flow.deflection(n) - coefficient(on.half_gap, n); });
    case GuardEvent::kLoadStops:
      return use([&](int n) { return side * flow.w2[n]; });
    case GuardEvent::kLoadBreaks:
      return use([&](int n) {
        return constant(model.drive.load_coulomb_friction, n) - side * (coefficient(on.load, n) + contact(n));
      });
    case GuardEvent::kMotorStops:
      return use([&](int n) { return side * flow.w1[n]; });
    case GuardEvent::kMotorBreaks:
      return use([&](int n) {
        T held = constant(has_load ? motor_level(guard.side) : breaking_level(guard.side, on), n);
        if (touching && model.gears_rub)
          held += static_cast<double>(mode.contact) * f.gear_friction * contact(n);
        return held - side * (motor_coefficient(on, n) - contact(n));
      });
    case GuardEvent::kNone:
      break;
  }
}

/// The time of an event as a function of everything that it depends on: one Newton step in Jet arithmetic
/// from the located value (the implicit function theorem).
template <class T>
T StepperImpl<T>::polished(const Guard& guard, const PowerSeries<T>& series, const Forcing<T>& on,
                           double time) const {
  if constexpr (!kIsJet<T>) {
    return time;
  } else {
    T value(0.0);
    double slope = 0.0;
    with_terms(guard, series, on, [&](const auto& term) {
      for (int n = guard.order; n >= 0; --n) {
        value = value * time + term(n);
        if (n > 0) slope = slope * time + n * guard.p[n];
      }
    });
    if (slope == 0.0) return T(time);
    T polished_time = -value / slope;
    polished_time.a = time;
    return polished_time;
  }
}

template <class T>
void StepperImpl<T>::cross(const Guard& guard) {
  switch (guard.event) {
    case GuardEvent::kOpen:
      open(guard.side);
      break;
    case GuardEvent::kClose:
      close(guard.side);
      break;
    case GuardEvent::kInside:
      mode.outside = 0;
      touching_side = guard.side;
      contact_zeros = 1;
      break;
    case GuardEvent::kLoadStops:
      z.w2 = T(0.0);
      resolve_load();
      break;
    case GuardEvent::kLoadBreaks:
      mode.load = guard.side;
      load_zeros = 2;  // both speed and acceleration start at zero
      break;
    case GuardEvent::kMotorStops:
      z.w1 = T(0.0);
      resolve_motor();
      break;
    case GuardEvent::kMotorBreaks:
      mode.motor = guard.side;
      motor_zeros = 2;
      break;
    case GuardEvent::kNone:
      break;
  }
}

template <class T>
void StepperImpl<T>::open(int side) {
  mode.contact = 0;
  if (locked) mode.load = 0;
  const bool beyond_edge = !f.rigid && value_of(f.c) > 0.0 && side_distance(side) > 0.0;
  mode.outside = beyond_edge ? side : 0;
  touching_side = side;
  contact_zeros = f.rigid ? 2 : 1;  // rigid bodies part with equal speeds
}

template <class T>
void StepperImpl<T>::close(int side) {
  closed = closed || !f.rigid || side * (value_of(z.w1) - value_of(z.w2)) > 0.0;
  if (f.rigid) return bounce(side);
  contact_zeros = mode.outside != 0 || value_of(f.c) == 0.0 ? 1 : 0;
  mode.contact = side;
  mode.outside = 0;
  // The contact torque may jump, which can break a sticking body loose at this instant.
  if (load_friction && mode.load == 0) resolve_load();
  if (motor_friction && mode.motor == 0) resolve_motor();
}

template <class T>
void StepperImpl<T>::bounce(int side) {
  const DriveParameters<T>& p = model.drive;
  const double e = model.structure.restitution;
  if (locked) {
    z.w1 = -e * z.w1;
  } else {
    const auto [w1, w2] = speeds_after_impact(z.w1, z.w2, p.mass_ratio, e);
    z.w1 = w1, z.w2 = w2;
  }
  if (load_friction) mode.load = direction_of(value_of(z.w2));
  if (motor_friction) mode.motor = direction_of(value_of(z.w1));
  // Bodies at rest that touch by rounding alone do not hold each other.
  if (load_friction && mode.load == 0) resolve_load();
  if (motor_friction && mode.motor == 0) resolve_motor();
  touching_side = side;
  contact_zeros = 1;
  const Outlook next = outlook(*this, z, acting_at(*this, forcing_now(), 0.0));
  const double parting = -side * next.delta_rate;
  const double pressing = side * (next.a1 - next.a2);
  if (pressing <= 0.0 || 2.0 * parting / pressing > kShortestBounce * dt) return;
  const T common = locked ? T(0.0) : T((z.w1 + p.mass_ratio * z.w2) / (1.0 + p.mass_ratio));
  z.w1 = z.w2 = common;
  mode.contact = side;
  touching_side = contact_zeros = 0;
  if (value_of(common) == 0.0) resolve_load();
}

template <class T>
void StepperImpl<T>::resolve_at_input_change() {
  if (mode.motor == 0) resolve_motor();
  if (mode.load == 0 && smooth && load_friction) resolve_load();
  if (!f.rigid || mode.contact == 0) return;
  if (mode.load == 0 && (load_friction || locked)) resolve_load();
  if (mode.contact * value_of(contact_torque(mode.contact)) < 0.0) open(mode.contact);
}

/// Brings an open or closed contact in line with a position that was set from outside.
template <class T>
void StepperImpl<T>::resolve_contact() {
  if (!has_load) return;
  if (mode.contact != 0) {
    // A locked load does not follow the motor: a contact that was parted is open, whatever its damper says.
    const double adhesion = value_of(model.adhesion);
    const bool parted = locked && adhesion <= 0.0 && side_distance(mode.contact) < 0.0;
    if (!parted && mode.contact * value_of(contact_torque(mode.contact)) >= -adhesion) return;
    mode.contact = 0;
  }
  mode.outside = 0;
  for (const int side : {1, -1}) {
    if (side_distance(side) <= 0.0) continue;
    if (side * value_of(contact_torque(side)) > 0.0)
      mode.contact = side;
    else
      mode.outside = side;
  }
}

/// A load at rest: sticks while the torque on it is within its friction, else starts in the torque's
/// direction.
template <class T>
void StepperImpl<T>::resolve_load() {
  if (f.rigid && mode.contact != 0) return resolve_as_one();
  if (locked) return;
  mode.load = 0;
  const double applied = value_of(acting_torque()) + value_of(forcing_now().load[0]);
  if (std::abs(applied) > value_of(model.drive.load_coulomb_friction)) mode.load = direction_of(applied);
  load_zeros = 1;
}

template <class T>
void StepperImpl<T>::resolve_motor() {
  if (f.rigid && mode.contact != 0) return resolve_as_one();
  mode.motor = 0;
  const double applied = value_of(motor_coefficient(forcing_now(), 0)) - value_of(acting_torque());
  const int direction = applied < 0.0 ? -1 : 1;
  if (std::abs(applied) > value_of(breaking_level(direction, forcing_now()))) mode.motor = direction;
  motor_zeros = 1;
}

/// Both bodies at rest in a closed rigid contact: their frictions hold them together.
template <class T>
void StepperImpl<T>::resolve_as_one() {
  load_zeros = motor_zeros = 1;
  const int load_before = mode.load;
  mode.load = 0;
  if (motor_friction) mode.motor = 0;
  if (locked) return;
  const Forcing<T> on = forcing_now();
  const double applied = value_of(motor_coefficient(on, 0)) + value_of(on.load[0]);
  double level = load_friction ? value_of(model.drive.load_coulomb_friction) : 0.0;
  if (motor_friction) level += value_of(breaking_level(applied < 0.0 ? -1 : 1, on));
  const int direction = std::abs(applied) > level ? direction_of(applied) : 0;
  mode.load = load_friction ? direction : load_before;
  if (motor_friction) mode.motor = direction;
}

}  // namespace gapscope::internal::simulation
