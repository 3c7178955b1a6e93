#pragma once

#include "gapscope/plant/scalar.h"
#include "gapscope/simulation/stepper.h"

namespace gapscope::internal::simulation {

/// Time since the start of a step at which the flow is told by its Taylor series, per unit of 1/rate; with
/// rate · h below this the truncated terms of order 15 are below 1e-14 of the state.
constexpr double kSeriesReach = 0.75;
constexpr int kSeriesOrder = 14;
constexpr double kReciprocal[kSeriesOrder + 1] = {0.0,      1.0,      1.0 / 2,  1.0 / 3,  1.0 / 4,
                                                  1.0 / 5,  1.0 / 6,  1.0 / 7,  1.0 / 8,  1.0 / 9,
                                                  1.0 / 10, 1.0 / 11, 1.0 / 12, 1.0 / 13, 1.0 / 14};

/// Numbers of the flow that do not change from step to step.
template <class T>
struct FlowConstants {
  T m1, m2, d1_plus, d1_minus, d2, k, c;
  T gear_friction{};  ///< of the contact torque, which the motor feels as friction [-]
  T decay_rate{};     ///< of a dying extra torque on the motor [1/s]
  bool rigid = false;
  bool rubs = false;     ///< gear_friction is in force, be it zero
  bool hardens = false;  ///< a compliant contact has torque beyond k(δ − sβ) + c δ̇
};

/// Torques and half gap as quadratics of the time since the start of the step: Σ f[n] sⁿ.
template <class T>
struct Forcing {
  T motor[3] = {T(0.0), T(0.0), T(0.0)};     ///< on the motor side, without dampers and contact [N m sⁿ]
  T load[3] = {T(0.0), T(0.0), T(0.0)};      ///< on the load side [N m]
  T half_gap[3] = {T(0.0), T(0.0), T(0.0)};  ///< β [rad]
  T decaying{};                              ///< amplitude of a dying torque on the motor [N m]
  T contact[3] = {T(0.0), T(0.0), T(0.0)};   ///< of the contact beyond k(δ − sβ) + c δ̇ [N m]
};

/// What the truncated terms may be, of the state: of the flow, and of one that only says where effects act.
constexpr double kExact = 1e-17, kRough = 1e-9;

/// Order of the series over a step h of a flow of the given rate: the least n with (rate h)ⁿ⁺¹/(n + 1)! below
/// `truncated` of the state, at least 4 for the quadratic torques, at most kSeriesOrder (which leaves 1e-14).
inline int series_order(double rate_times_h, double truncated = kExact) {
  double term = rate_times_h;
  int n = 0;
  while (n < kSeriesOrder && (term > truncated || n < 4)) {
    ++n;
    term *= rate_times_h / (n + 1);
  }
  return n;
}

/// The exact flow of one mode as Taylor polynomials in the time since its start.
template <class T>
struct PowerSeries {
  int order = kSeriesOrder;
  int load_order = kSeriesOrder;  ///< 0: the load rests, and has no further terms
  T x1[kSeriesOrder + 1], w1[kSeriesOrder + 1], x2[kSeriesOrder + 1], w2[kSeriesOrder + 1];
  T torque[kSeriesOrder +
           1];  ///< contact torque τc; outside a closed contact the torque it would have on `side`

  /// Term of x1 − x2.
  T deflection(int n) const { return n <= load_order ? T(x1[n] - x2[n]) : x1[n]; }
};

template <class T>
T coefficient(const T (&f)[3], int n) {
  return n < 3 ? f[n] : T(0.0);
}

/// Torque on the motor, term by term: the quadratic and the exponential. Called with n = 0, 1, 2, … in turn.
template <class T>
class MotorTorque {
 public:
  MotorTorque(const FlowConstants<T>& f, const Forcing<T>& on) : f_(f), on_(on), decaying_(on.decaying) {}
  T term(int n) {
    T sum = coefficient(on_.motor, n);
    if (value_of(f_.decay_rate) == 0.0) return sum;
    sum += decaying_;
    decaying_ *= -f_.decay_rate / (n + 1.0);
    return sum;
  }

 private:
  const FlowConstants<T>& f_;
  const Forcing<T>& on_;
  T decaying_;
};

/// Contact torque k(δ − sβ) + c δ̇ and what is beyond, term by term; zero on no side.
template <class T>
T torque_term(const FlowConstants<T>& f, const PowerSeries<T>& z, int n, int side, const Forcing<T>& on) {
  T delta = z.deflection(n), rate = z.w1[n];
  if (n <= z.load_order) rate -= z.w2[n];
  if (n < 3) delta -= static_cast<double>(side) * on.half_gap[n];
  T torque = f.k * delta + f.c * rate;
  if (f.hardens && n < 3) torque += on.contact[n];
  return torque;
}

/// What of a contact torque the motor feels where its gears rub: 1 + μ where it drives, 1 − μ where it is
/// driven.
template <class T>
T felt_share(const FlowConstants<T>& f, const ContactMode& mode) {
  return 1.0 + static_cast<double>(mode.motor * mode.contact) * f.gear_friction;
}

/// Builds the flow of `mode` from `start`: compliant or open contact. The motor and the load each move or
/// stick.
template <class T>
void compliant_series(const FlowConstants<T>& f, const ContactMode& mode, const DriveState<T>& start,
                      const Forcing<T>& on, PowerSeries<T>& z) {
  const T& d1 = mode.motor < 0 ? f.d1_minus : f.d1_plus;
  const T inverse_m1 = 1.0 / f.m1;
  const T inverse_m2 = 1.0 / f.m2;
  const int side = mode.contact != 0 ? mode.contact : mode.outside;
  MotorTorque<T> motor(f, on);
  z.x1[0] = start.x1, z.w1[0] = start.w1, z.x2[0] = start.x2, z.w2[0] = start.w2;
  z.load_order = mode.load == 0 ? 0 : z.order;
  for (int n = 0;; ++n) {
    z.torque[n] = side != 0 ? torque_term(f, z, n, side, on) : T(0.0);
    if (n == z.order) break;
    const double next = kReciprocal[n + 1];
    T contact = mode.contact != 0 ? z.torque[n] : T(0.0);
    z.x1[n + 1] = z.w1[n] * next;
    if (n < z.load_order) {
      z.x2[n + 1] = z.w2[n] * next;
      z.w2[n + 1] = (coefficient(on.load, n) - f.d2 * z.w2[n] + contact) * inverse_m2 * next;
    }
    if (f.rubs) contact *= felt_share(f, mode);
    z.w1[n + 1] = mode.motor == 0 ? T(0.0) : (motor.term(n) - d1 * z.w1[n] - contact) * inverse_m1 * next;
  }
}

/// The same for a closed rigid contact: both bodies move as one, the torque is what holds them together.
template <class T>
void rigid_series(const FlowConstants<T>& f, const ContactMode& mode, const DriveState<T>& start,
                  const Forcing<T>& on, PowerSeries<T>& z) {
  const T& d1 = mode.motor < 0 ? f.d1_minus : f.d1_plus;
  const T felt = felt_share(f, mode);
  const T inverse_m = 1.0 / (f.m1 + felt * f.m2);
  const bool moves = mode.load != 0 && mode.motor != 0;
  MotorTorque<T> motor_torque(f, on);
  z.load_order = z.order;
  z.x1[0] = start.x1, z.w1[0] = start.w1, z.x2[0] = start.x2, z.w2[0] = start.w1;
  for (int n = 0;; ++n) {
    const T motor = motor_torque.term(n) - d1 * z.w1[n];
    const T acceleration =
        moves ? T((motor + felt * (coefficient(on.load, n) - f.d2 * z.w1[n])) * inverse_m) : T(0.0);
    z.torque[n] = moves ? T((motor - f.m1 * acceleration) / felt) : motor;
    if (n == z.order) break;
    const double next = kReciprocal[n + 1];
    z.x1[n + 1] = z.w1[n] * next;
    z.x2[n + 1] = z.x1[n + 1];
    z.w1[n + 1] = acceleration * next;
    z.w2[n + 1] = z.w1[n + 1];
  }
}

template <class T>
void flow_series(const FlowConstants<T>& f, const ContactMode& mode, const DriveState<T>& start,
                 const Forcing<T>& on, PowerSeries<T>& z) {
  if (f.rigid && mode.contact != 0)
    rigid_series(f, mode, start, on, z);
  else
    compliant_series(f, mode, start, on, z);
}

template <class T>
T evaluate(const T (&coefficients)[kSeriesOrder + 1], int order, const T& s) {
  T sum(coefficients[order]);
  for (int n = order - 1; n >= 0; --n) sum = sum * s + coefficients[n];
  return sum;
}

template <class T>
DriveState<T> evaluate(const PowerSeries<T>& z, const T& s) {
  return {evaluate(z.x1, z.order, s), evaluate(z.w1, z.order, s), evaluate(z.x2, z.load_order, s),
          evaluate(z.w2, z.load_order, s)};
}

}  // namespace gapscope::internal::simulation
