#pragma once

#include "simulation/stepper_impl.h"

namespace gapscope::internal::simulation {

template <class T>
StateTransition<T>& StepperImpl<T>::transition(const T& span, int index, int times_halved) {
  const int row = (mode.contact != 0 ? 6 : 0) + (mode.load != 0 ? 3 : 0) + (mode.motor + 1);
  StateTransition<T>& found = transitions[index][row][times_halved];
  if (!found.ready) prepare(f, mode, has_load, span, smooth, times_halved, found);
  return found;
}

/// How often a piece of length h has to be halved for the effects at this point.
template <class T>
int StepperImpl<T>::halvings(double h) const {
  if (!smooth) return 0;
  const double rate = effect_rate();
  int count = 0;
  while (rate * h > kEffectReach && count < kMostHalvings) h *= 0.5, ++count;
  return count;
}

template <class T>
void StepperImpl<T>::respond(const StateTransition<T>& step, const Forcing<T>& on,
                             DriveState<T>& next) const {
  const auto& r = step.response;
  if (mode.contact == 0) {
    next.x1 = z.x1 + r[1][0] * z.w1 + r[3][0] * on.motor[0];
    next.w1 = r[1][1] * z.w1 + r[3][1] * on.motor[0];
    if (decaying >= 0) {
      next.x1 += r[9][0] * on.decaying;
      next.w1 += r[9][1] * on.decaying;
    }
    if (!has_load || mode.load == 0) {
      next.x2 = z.x2, next.w2 = z.w2;
      return;
    }
    next.x2 = z.x2 + r[2][2] * z.w2 + r[4][2] * on.load[0];
    next.w2 = r[2][3] * z.w2 + r[4][3] * on.load[0];
    return;
  }
  const T depth = z.x1 - z.x2 - static_cast<double>(mode.contact) * on.half_gap[0];
  T out[4];
  for (int i = 0; i < 4; ++i)
    out[i] = r[0][i] * depth + r[1][i] * z.w1 + r[2][i] * z.w2 + r[3][i] * on.motor[0] + r[4][i] * on.load[0];
  if (decaying >= 0)
    for (int i = 0; i < 4; ++i) out[i] += r[9][i] * on.decaying;
  next = {z.x1 + out[0], out[1], z.x2 + out[2], out[3]};
}

/// Adds what the slopes and curvatures of the torques do. A gap that opens under a closed contact pushes on
/// both bodies like a pair of torques k s β.
template <class T>
void StepperImpl<T>::respond_to_slopes(const StateTransition<T>& step, const Forcing<T>& on,
                                       DriveState<T>& next) const {
  const auto& r = step.response;
  if (mode.contact == 0) {
    next.x1 += r[5][0] * on.motor[1] + r[7][0] * on.motor[2];
    next.w1 += r[5][1] * on.motor[1] + r[7][1] * on.motor[2];
    if (!has_load || mode.load == 0) return;
    next.x2 += r[6][2] * on.load[1] + r[8][2] * on.load[2];
    next.w2 += r[6][3] * on.load[1] + r[8][3] * on.load[2];
    return;
  }
  T motor[2] = {on.motor[1], on.motor[2]}, load[2] = {on.load[1], on.load[2]};
  if (moves_gap && !f.rigid) {
    const T pushing = static_cast<double>(mode.contact) * f.k;
    for (int n = 0; n < 2; ++n) {
      motor[n] += pushing * on.half_gap[n + 1];
      load[n] -= pushing * on.half_gap[n + 1];
    }
  }
  T* const out[4] = {&next.x1, &next.w1, &next.x2, &next.w2};
  for (int i = 0; i < 4; ++i)
    *out[i] += r[5][i] * motor[0] + r[6][i] * load[0] + r[7][i] * motor[1] + r[8][i] * load[1];
}

/// The state half-way on the cubics through both ends.
template <class T>
DriveState<T> middle_between(const DriveState<T>& a, const DriveState<T>& b, const T& h, const T& inverse_h) {
  return {0.5 * (a.x1 + b.x1) + 0.125 * h * (a.w1 - b.w1),
          1.5 * (b.x1 - a.x1) * inverse_h - 0.25 * (a.w1 + b.w1),
          0.5 * (a.x2 + b.x2) + 0.125 * h * (a.w2 - b.w2),
          1.5 * (b.x2 - a.x2) * inverse_h - 0.25 * (a.w2 + b.w2)};
}

/// A whole piece with smooth effects: constant torques predict the motion, their quadratic along it corrects
/// it.
template <class T>
void StepperImpl<T>::advance_smoothly(const StateTransition<T>& step, Forcing<T>& on,
                                      DriveState<T>& next) const {
  const Extra<T> start = extra_at(z, now);
  add_constant(on, start);
  respond(step, on, next);
  const DriveState<T> constant = next;
  const T& h = step.h;
  for (int pass = 0; pass < kCorrections; ++pass) {
    const DriveState<T> middle = middle_between(z, next, h, step.inverse_h);
    bend(on, start, extra_at(middle, now + 0.5 * h), extra_at(next, now + h), step.inverse_h);
    next = constant;
    respond_to_slopes(step, on, next);
  }
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

/// What acts at one end of a step, without friction, dampers and contact: values and rates.
struct Acting {
  double half_gap, half_gap_rate, motor, motor_rate, load, load_rate;
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
          value(on.load),     slope(on.load)};
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
  const double contact = d.mode.contact != 0 ? q.torque : 0.0;
  const double d1 = value_of(d.mode.motor < 0 ? d.f.d1_minus : d.f.d1_plus);
  q.a1 = d.mode.motor == 0 ? 0.0 : (on.motor - d1 * q.w1 - contact) * d.inverse_m1;
  q.a2 = d.mode.load == 0 ? 0.0 : (on.load - value_of(d.f.d2) * q.w2 + contact) * d.inverse_m2;
  q.torque_rate = k * (q.delta_rate - side * on.half_gap_rate) + c * (q.a1 - q.a2);
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

template <class T>
void StepperImpl<T>::accept(const DriveState<T>& next, const T& h) {
  if (remembers) advance_memory(next, now + h);
  z = next;
  now += h;
}

template <class T>
void StepperImpl<T>::step(double u) {
  closed = false;
  if (!started) {
    std::fill(inputs.begin(), inputs.end(), u);
    set_input(u);
    remember_start();
    started = true;
  }
  if (varies_inertia) set_inertia();
  if (delayed) {
    newest = (newest + 1) % inputs.size();
    inputs[newest] = u;
    const std::size_t oldest = (newest + 1) % inputs.size();
    segment(delay_rest, inputs[oldest], 0);
    segment(dt - delay_rest, inputs[(oldest + 1) % inputs.size()], 1);
  } else {
    segment(T(dt), u, 0);
  }
  const double sum = value_of(z.x1) + value_of(z.w1) + value_of(z.x2) + value_of(z.w2);
  if (!(std::abs(sum) < 1e12)) healthy = false;
}

/// Part of a sample in which the input is constant.
template <class T>
void StepperImpl<T>::segment(const T& span, double u, int index) {
  set_input(u);
  resolve_at_input_change();
  const StateTransition<T>* whole = &transition(span, index, 0);
  if (smooth) whole = &transition(span, index, halvings(value_of(whole->h)));
  DriveState<T> next;
  Forcing<T> on = forcing_without_effects();
  Acting at_start{value_of(on.half_gap[0]), 0.0, value_of(on.motor[0]), 0.0, value_of(on.load[0]), 0.0};
  Acting at_end = at_start;
  for (int piece = 0; piece < whole->pieces; ++piece) {
    if (smooth) {
      on = forcing_without_effects();
      advance_smoothly(*whole, on, next);
      at_start = acting_at(*this, on, 0.0), at_end = acting_at(*this, on, value_of(whole->h));
    } else if (decaying >= 0) {
      on = forcing_without_effects();
      respond(*whole, on, next);
      at_start = acting_at(*this, on, 0.0), at_end = acting_at(*this, on, value_of(whole->h));
    } else {
      respond(*whole, on, next);
    }
    if (may_leave(next, at_start, at_end, value_of(whole->h))) {
      advance(span - static_cast<double>(piece) * whole->h);
      return;
    }
    accept(next, whole->h);
    forget_zeros();
  }
}

/// The flow over h as a series, smooth effects as the quadratic along it.
template <class T>
void StepperImpl<T>::build_series(const T& h, PowerSeries<T>& series, Forcing<T>& on) const {
  on = forcing_without_effects();
  if (!smooth) return flow_series(f, mode, z, on, series);
  const Extra<T> start = extra_at(z, now);
  add_constant(on, start);
  flow_series(f, mode, z, on, series);
  if (value_of(h) <= 0.0) return;
  const T inverse_h = 1.0 / h;
  for (int pass = 0; pass < kCorrections + 1; ++pass) {
    const Extra<T> middle = extra_at(evaluate(series, T(0.5 * h)), now + 0.5 * h);
    bend(on, start, middle, extra_at(evaluate(series, h), now + h), inverse_h);
    flow_series(f, mode, z, on, series);
  }
}

/// The exact path: Taylor series of the running mode up to its first event, then on in the next mode.
template <class T>
void StepperImpl<T>::advance(T span) {
  const double least = 1e-13 * dt;
  PowerSeries<T> series;
  Forcing<T> on;
  for (int count = 0;; ++count) {
    if (count > kMostEventsPerSample) {
      healthy = false;
      return;
    }
    const double rate =
        std::max(flow_rate(f, mode.contact != 0 || mode.outside != 0, has_load), value_of(f.decay_rate));
    double reach = (smooth ? kSmoothReach : kSeriesReach) / rate;
    if (smooth) reach = std::min(reach, kEffectReach / std::max(effect_rate(), 1e-9));
    const double pieces = std::max(1.0, std::ceil(value_of(span) / reach));
    const bool last = pieces == 1.0;
    const T h = span / pieces;
    series.order = series_order(rate * value_of(h));
    build_series(h, series, on);
    FirstEvent event;
    GuardSet set;
    if (value_of(h) > least) {
      collect(series, on, set);
      event = first_event(set, value_of(h));
    }
    if (event.guard < 0) {
      accept(evaluate(series, h), h);
      forget_zeros();
      if (last) return;
      span -= h;
      continue;
    }
    const Guard& guard = set.guards[static_cast<std::size_t>(event.guard)];
    const T time = polished(guard, series, on, event.time);
    accept(evaluate(series, time), time);
    span -= time;
    if (event.time > least) forget_zeros();
    ++events;
    cross(guard);
  }
}

}  // namespace gapscope::internal::simulation
