#pragma once

#include "simulation/stepper_impl.h"

namespace gapscope::internal::simulation {

/// Whether a guard may fall to zero between two states h apart, judged by its values and slopes at both ends.
/// A yes may be wrong, a no is not: within the series' reach guards are nearly cubic, and one that dips
/// between rising ends stays above the crossing of its end tangents.
inline bool dips(double g0, double slope0, double g1, double slope1, double h) {
  if (g1 <= 0.0) return true;
  if (!(slope0 < 0.0 && slope1 > 0.0)) return false;
  const double s = (g1 - g0 - slope1 * h) / (slope0 - slope1);
  return g0 + slope0 * s <= 0.0;
}

/// What acts at one end of a step, without friction, dampers and contact: values and rates.
struct Acting {
  double half_gap, half_gap_rate, motor, motor_rate, load, load_rate;
  double contact = 0.0, contact_rate = 0.0;  ///< what of it no spring or damper explains
};

template <class T>
Acting acting_at(const StepperImpl<T>& d, const Forcing<T>& on, double s) {
  const auto value = [s](const T(&c)[3]) {
    return value_of(c[0]) + s * (value_of(c[1]) + s * value_of(c[2]));
  };
  const auto slope = [s](const T(&c)[3]) { return value_of(c[1]) + 2.0 * s * value_of(c[2]); };
  const double rate = value_of(d.f.decay_rate);
  const double dying = rate > 0.0 ? value_of(on.decaying) * std::exp(-rate * s) : 0.0;
  return {value(on.half_gap), slope(on.half_gap), value(on.motor) + dying, slope(on.motor) - rate * dying,
          value(on.load),     slope(on.load),     value(on.contact),       slope(on.contact)};
}

/// What the guards look at, at one end of a step.
struct Outlook {
  double delta, delta_rate, torque, torque_rate;  ///< contact, where it is closed or beyond the edge
  double w1, a1, w2, a2;
};

template <class T>
Outlook outlook(const StepperImpl<T>& d, const DriveState<T>& z, const Acting& on) {
  Outlook q;
  const int side = d.mode.contact != 0 ? d.mode.contact : d.mode.outside;
  const double k = side != 0 ? value_of(d.f.k) : 0.0, c = side != 0 ? value_of(d.f.c) : 0.0;
  q.w1 = value_of(z.w1), q.w2 = value_of(z.w2);
  q.delta = value_of(z.x1) - value_of(z.x2), q.delta_rate = q.w1 - q.w2;
  q.torque = k * (q.delta - side * on.half_gap) + c * q.delta_rate;
  if (d.f.hardens) q.torque += on.contact;
  const double contact = d.mode.contact != 0 ? q.torque : 0.0;
  const double d1 = value_of(d.mode.motor < 0 ? d.f.d1_minus : d.f.d1_plus);
  double felt = contact;
  if (d.f.rubs) felt *= 1.0 + d.mode.motor * d.mode.contact * value_of(d.f.gear_friction);
  q.a1 = d.mode.motor == 0 ? 0.0 : (on.motor - d1 * q.w1 - felt) * d.inverse_m1;
  q.a2 = d.mode.load == 0 ? 0.0 : (on.load - value_of(d.f.d2) * q.w2 + contact) * d.inverse_m2;
  q.torque_rate = k * (q.delta_rate - side * on.half_gap_rate) + c * (q.a1 - q.a2);
  if (d.f.hardens) q.torque_rate += on.contact_rate;
  return q;
}

inline bool contact_may_leave(int contact, double adhesion, const Outlook& a, const Outlook& b, double h) {
  return dips(adhesion + contact * a.torque, contact * a.torque_rate, adhesion + contact * b.torque,
              contact * b.torque_rate, h);
}

inline bool gap_may_close(const Outlook& a, const Acting& at_a, const Outlook& b, const Acting& at_b,
                          double h) {
  return dips(at_a.half_gap - a.delta, at_a.half_gap_rate - a.delta_rate, at_b.half_gap - b.delta,
              at_b.half_gap_rate - b.delta_rate, h) ||
         dips(at_a.half_gap + a.delta, at_a.half_gap_rate + a.delta_rate, at_b.half_gap + b.delta,
              at_b.half_gap_rate + b.delta_rate, h);
}

/// A sticking body: level ∓ applied torque.
inline bool may_break(double plus, double minus, double applied0, double rate0, double applied1, double rate1,
                      double h) {
  return dips(plus - applied0, -rate0, plus - applied1, -rate1, h) ||
         dips(minus + applied0, rate0, minus + applied1, rate1, h);
}

template <class T>
bool StepperImpl<T>::may_leave(const DriveState<T>& next, const Acting& at_start, const Acting& at_end,
                               double h) const {
  if (!has_load && !motor_friction) return false;
  if ((f.rigid && mode.contact != 0) || mode.outside != 0) return true;  // the exact path decides
  const Outlook a = outlook(*this, z, at_start), b = outlook(*this, next, at_end);
  const double closed_now = mode.contact != 0 ? 1.0 : 0.0;
  if (mode.contact != 0) {
    if (contact_may_leave(mode.contact, value_of(model.adhesion), a, b, h)) return true;
  } else if (has_load && gap_may_close(a, at_start, b, at_end, h)) {
    return true;
  }
  if (motor_friction && mode.motor != 0 &&
      dips(mode.motor * a.w1, mode.motor * a.a1, mode.motor * b.w1, mode.motor * b.a1, h))
    return true;
  if (motor_friction && mode.motor == 0 && model.gears_rub) return true;  // the exact path decides
  if (motor_friction && mode.motor == 0 &&
      may_break(value_of(motor_level(1)), value_of(motor_level(-1)), at_start.motor - closed_now * a.torque,
                at_start.motor_rate - closed_now * a.torque_rate, at_end.motor - closed_now * b.torque,
                at_end.motor_rate - closed_now * b.torque_rate, h))
    return true;
  if (!load_friction) return false;
  if (mode.load != 0) return dips(mode.load * a.w2, mode.load * a.a2, mode.load * b.w2, mode.load * b.a2, h);
  if (mode.contact == 0 && !smooth) return false;
  const double level = value_of(model.drive.load_coulomb_friction);
  return may_break(level, level, at_start.load + closed_now * a.torque,
                   at_start.load_rate + closed_now * a.torque_rate, at_end.load + closed_now * b.torque,
                   at_end.load_rate + closed_now * b.torque_rate, h);
}

}  // namespace gapscope::internal::simulation
