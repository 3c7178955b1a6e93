#pragma once

#include "gapscope/base/require.h"
#include "gapscope/plant/impact.h"
#include "simulation/guards.h"
#include "simulation/transition.h"

namespace gapscope::internal {

constexpr int kMostEventsPerSample = 2000;

/// A rigid contact whose next bounce would last less than this share of a sample stays closed: the height of
/// such a bounce, a quarter of its duration times its speed, is far below any encoder.
constexpr double kShortestBounce = 1e-3;

template <class T>
struct StepperImpl {
  StepperModel<T> model;
  FlowConstants<T> f;
  double dt = 0.0;
  bool has_load = true, locked = false, load_friction = true, motor_friction = false;
  T half_gap{};

  DriveState<T> z;
  ContactMode mode;
  int touching_side = 0;  ///< side of an open contact whose guard starts at zero
  int contact_zeros = 0, load_zeros = 0, motor_zeros = 0;  ///< see Guard::zeros
  T torque{};                                              ///< Km u of the running sample [N m]
  bool closed = false;
  bool healthy = true;
  long events = 0;
  Transition<T> transitions[12];

  StepperImpl(const StepperModel<T>& m, double step);

  // --- where things stand
  // -------------------------------------------------------------------------------------
  double side_distance(int side) const;  ///< s δ − β [rad]
  T contact_torque(int side) const;  ///< k(δ − sβ) + c δ̇; for a closed rigid contact the holding torque
  T acting_torque() const { return mode.contact != 0 ? contact_torque(mode.contact) : T(0.0); }
  const T& motor_level(int direction) const {
    return direction < 0 ? model.motor_friction_minus : model.motor_friction_plus;
  }

  // --- one sample
  // ---------------------------------------------------------------------------------------------
  void reset(const DriveState<T>& state);
  void step(double u);
  void inject(const T& dx1, const T& dw1);
  Forcing<T> forcing() const;
  Transition<T>& transition();
  void apply(const Transition<T>& step, DriveState<T>& next) const;
  bool may_leave(const DriveState<T>& next, double h) const;
  void advance(T span);

  // --- events
  // -------------------------------------------------------------------------------------------------
  void collect(const Series<T>& series, GuardSet& set) const;
  T guard_term(const Guard& guard, const Series<T>& series, int n) const;
  T polished(const Guard& guard, const Series<T>& series, double time) const;
  void cross(const Guard& guard);
  void open(int side);
  void close(int side);
  void bounce(int side);
  void resolve_at_sample_start();
  void resolve_contact();
  void resolve_load();
  void resolve_motor();
  void forget_zeros() { contact_zeros = load_zeros = motor_zeros = touching_side = 0; }
};

inline int sign_of(double v) { return v > 0.0 ? 1 : v < 0.0 ? -1 : 0; }

template <class T>
StepperImpl<T>::StepperImpl(const StepperModel<T>& m, double step) : model(m), dt(step) {
  const DriveParameters<T>& p = m.drive;
  has_load = m.structure.has_load;
  locked = has_load && m.structure.load == LoadKind::kLocked;
  load_friction = has_load && !locked && m.load_sticks;
  motor_friction = m.motor_sticks;
  GAPSCOPE_REQUIRE(step > 0.0);
  GAPSCOPE_REQUIRE(value_of(p.motor_inertia) > 0.0);
  GAPSCOPE_REQUIRE(!has_load || locked || value_of(p.mass_ratio) > 0.0);
  f.m1 = p.motor_inertia;
  f.m2 = has_load && !locked ? T(p.motor_inertia * p.mass_ratio) : T(p.motor_inertia);
  f.d1_plus = f.d1_minus = p.motor_damping;
  f.d2 = has_load && !locked ? p.load_damping : T(0.0);
  f.k = p.contact_stiffness;
  f.c = p.contact_damping;
  f.rigid = m.structure.contact == ContactLaw::kRigid;
  half_gap = 0.5 * p.gap;
  reset({});
}

template <class T>
double StepperImpl<T>::side_distance(int side) const {
  return side * (value_of(z.x1) - value_of(z.x2)) - value_of(half_gap);
}

template <class T>
T StepperImpl<T>::contact_torque(int side) const {
  if (!f.rigid) return f.k * (z.x1 - z.x2 - static_cast<double>(side) * half_gap) + f.c * (z.w1 - z.w2);
  const Forcing<T> on = forcing();
  if (mode.load == 0 || mode.motor == 0) return on.motor[0];
  const T motor = on.motor[0] - f.d1_plus * z.w1;
  return motor - f.m1 * ((motor + on.load[0] - f.d2 * z.w1) / (f.m1 + f.m2));
}

template <class T>
void StepperImpl<T>::reset(const DriveState<T>& state) {
  z = state;
  mode = {};
  closed = false;
  healthy = true;
  events = 0;
  torque = T(0.0);
  forget_zeros();
  if (locked) z.w2 = T(0.0);
  if (motor_friction) mode.motor = sign_of(value_of(z.w1));
  if (locked || load_friction) mode.load = sign_of(value_of(z.w2));
  if (!f.rigid) resolve_contact();
  if (load_friction && mode.load == 0) resolve_load();
}

template <class T>
Forcing<T> StepperImpl<T>::forcing() const {
  Forcing<T> on;
  on.motor[0] = torque;
  if (motor_friction && mode.motor != 0)
    on.motor[0] -= static_cast<double>(mode.motor) * motor_level(mode.motor);
  if (load_friction) on.load[0] = -static_cast<double>(mode.load) * model.drive.load_coulomb_friction;
  on.half_gap[0] = half_gap;
  return on;
}

template <class T>
Transition<T>& StepperImpl<T>::transition() {
  const int index = (mode.contact != 0 ? 6 : 0) + (mode.load != 0 ? 3 : 0) + (mode.motor + 1);
  Transition<T>& found = transitions[index];
  if (!found.ready) prepare(f, mode, has_load, dt, found);
  return found;
}

template <class T>
void StepperImpl<T>::apply(const Transition<T>& step, DriveState<T>& next) const {
  const Forcing<T> on = forcing();
  const auto& r = step.response;
  if (mode.contact == 0) {
    next.x1 = z.x1 + r[0][1] * z.w1 + r[0][3] * on.motor[0];
    next.w1 = r[1][1] * z.w1 + r[1][3] * on.motor[0];
    if (!has_load || mode.load == 0) {
      next.x2 = z.x2, next.w2 = z.w2;
      return;
    }
    next.x2 = z.x2 + r[2][2] * z.w2 + r[2][4] * on.load[0];
    next.w2 = r[3][2] * z.w2 + r[3][4] * on.load[0];
    return;
  }
  const T depth = z.x1 - z.x2 - static_cast<double>(mode.contact) * half_gap;
  const T out[4] = {
      r[0][0] * depth + r[0][1] * z.w1 + r[0][2] * z.w2 + r[0][3] * on.motor[0] + r[0][4] * on.load[0],
      r[1][0] * depth + r[1][1] * z.w1 + r[1][2] * z.w2 + r[1][3] * on.motor[0] + r[1][4] * on.load[0],
      r[2][0] * depth + r[2][1] * z.w1 + r[2][2] * z.w2 + r[2][3] * on.motor[0] + r[2][4] * on.load[0],
      r[3][0] * depth + r[3][1] * z.w1 + r[3][2] * z.w2 + r[3][3] * on.motor[0] + r[3][4] * on.load[0]};
  next = {z.x1 + out[0], out[1], z.x2 + out[2], out[3]};
}

/// Whether a guard may fall to zero between two states h apart, judged by its values and slopes at both ends.
/// A yes may be wrong, a no is not: within the series' reach guards are nearly cubic, and one that dips
/// between rising ends stays above the crossing of its end tangents.
inline bool dips(double g0, double slope0, double g1, double slope1, double h) {
  if (g1 <= 0.0) return true;
  if (!(slope0 < 0.0 && slope1 > 0.0)) return false;
  const double s = (g1 - g0 - slope1 * h) / (slope0 - slope1);
  return g0 + slope0 * s <= 0.0;
}

/// Values of one state that the guards need.
struct Kinematics {
  double delta, delta_rate, torque, torque_rate, w1, a1, w2, a2;
};

template <class T>
Kinematics kinematics(const StepperImpl<T>& d, const DriveState<T>& z, double motor, double load) {
  Kinematics q{};
  const int side = d.mode.contact != 0 ? d.mode.contact : d.mode.outside;
  q.w1 = value_of(z.w1), q.w2 = value_of(z.w2);
  q.delta = value_of(z.x1) - value_of(z.x2);
  q.delta_rate = q.w1 - q.w2;
  const double k = value_of(d.f.k), c = value_of(d.f.c);
  const double tau = side != 0 ? k * (q.delta - side * value_of(d.half_gap)) + c * q.delta_rate : 0.0;
  const double acting = d.mode.contact != 0 ? tau : 0.0;
  const double d1 = value_of(d.mode.motor < 0 ? d.f.d1_minus : d.f.d1_plus);
  q.a1 = d.mode.motor == 0 ? 0.0 : (motor - d1 * q.w1 - acting) / value_of(d.f.m1);
  q.a2 = d.mode.load == 0 ? 0.0 : (load - value_of(d.f.d2) * q.w2 + acting) / value_of(d.f.m2);
  q.torque = tau;
  q.torque_rate = k * q.delta_rate + c * (q.a1 - q.a2);
  return q;
}

template <class T>
bool StepperImpl<T>::may_leave(const DriveState<T>& next, double h) const {
  if (!has_load && !motor_friction) return false;
  if (f.rigid && mode.contact != 0) return true;  // few samples; the exact path decides
  const Forcing<T> on = forcing();
  const double motor = value_of(on.motor[0]), load = value_of(on.load[0]);
  const Kinematics a = kinematics(*this, z, motor, load), b = kinematics(*this, next, motor, load);
  const double beta = value_of(half_gap);
  if (motor_friction) {
    if (mode.motor != 0) {
      if (dips(mode.motor * a.w1, mode.motor * a.a1, mode.motor * b.w1, mode.motor * b.a1, h)) return true;
    } else if (mode.contact != 0) {
      const double net0 = value_of(torque) - a.torque, net1 = value_of(torque) - b.torque;
      if (dips(value_of(motor_level(1)) - net0, a.torque_rate, value_of(motor_level(1)) - net1, b.torque_rate,
               h) ||
          dips(value_of(motor_level(-1)) + net0, -a.torque_rate, value_of(motor_level(-1)) + net1,
               -b.torque_rate, h))
        return true;
    }
  }
  if (!has_load) return false;
  if (mode.contact != 0) {
    const int s = mode.contact;
    if (dips(s * a.torque, s * a.torque_rate, s * b.torque, s * b.torque_rate, h)) return true;
  } else if (mode.outside != 0) {
    return true;  // lasts for a fraction of a contact; the exact path decides
  } else if (dips(beta - a.delta, -a.delta_rate, beta - b.delta, -b.delta_rate, h) ||
             dips(beta + a.delta, a.delta_rate, beta + b.delta, b.delta_rate, h)) {
    return true;
  }
  if (!load_friction) return false;
  if (mode.load != 0) return dips(mode.load * a.w2, mode.load * a.a2, mode.load * b.w2, mode.load * b.a2, h);
  if (mode.contact == 0) return false;
  const double level = value_of(model.drive.load_coulomb_friction);
  return dips(level - a.torque, -a.torque_rate, level - b.torque, -b.torque_rate, h) ||
         dips(level + a.torque, a.torque_rate, level + b.torque, b.torque_rate, h);
}

template <class T>
void StepperImpl<T>::step(double u) {
  torque = model.drive.torque_constant * u;
  closed = false;
  resolve_at_sample_start();
  const Transition<T>& whole = transition();
  DriveState<T> next;
  for (int piece = 0; piece < whole.pieces; ++piece) {
    apply(whole, next);
    if (may_leave(next, whole.h)) {
      advance(T(dt - piece * whole.h));
      break;
    }
    z = next;
    forget_zeros();
  }
  const double sum = value_of(z.x1) + value_of(z.w1) + value_of(z.x2) + value_of(z.w2);
  if (!(std::abs(sum) < 1e12)) healthy = false;
}

/// The exact path: Taylor series of the running mode up to its first event, then on in the next mode.
template <class T>
void StepperImpl<T>::advance(T span) {
  const double least = 1e-13 * dt;
  Series<T> series;
  for (int count = 0;; ++count) {
    if (count > kMostEventsPerSample) {
      healthy = false;
      return;
    }
    flow_series(f, mode, z, forcing(), series);
    const double reach = kSeriesReach / flow_rate(f, mode.contact != 0 || mode.outside != 0, has_load);
    const bool last = value_of(span) <= reach;
    const T h = last ? span : T(reach);
    FirstEvent event;
    GuardSet set;
    if (value_of(h) > least) {
      collect(series, set);
      event = first_event(set, value_of(h));
    }
    if (event.guard < 0) {
      z = evaluate(series, h);
      forget_zeros();
      if (last) return;
      span -= h;
      continue;
    }
    const Guard& guard = set.guards[static_cast<std::size_t>(event.guard)];
    const T time = polished(guard, series, event.time);
    z = evaluate(series, time);
    span -= time;
    if (event.time > least) forget_zeros();
    ++events;
    cross(guard);
  }
}

template <class T>
void StepperImpl<T>::inject(const T& dx1, const T& dw1) {
  z.x1 += dx1;
  if (mode.motor != 0) z.w1 += dw1;
  if (mode.contact != 0) {
    if (!locked) z.x2 += dx1;
    if (mode.load != 0) z.w2 += dw1;
  }
  if (motor_friction && mode.motor != 0 && mode.motor * value_of(z.w1) < 0.0) mode.motor = -mode.motor;
  if (load_friction && mode.load != 0 && mode.load * value_of(z.w2) < 0.0) mode.load = -mode.load;
  forget_zeros();
  if (!f.rigid) resolve_contact();
}

}  // namespace gapscope::internal
