#pragma once

#include <algorithm>
#include <cmath>

#include "simulation/series.h"

namespace gapscope::internal::simulation {

/// What the state at the end of a step is linear in.
enum Column { kDepth, kW1, kW2, kMotor0, kLoad0, kMotor1, kLoad1, kMotor2, kLoad2, kDying, kColumns };

/// What each of them moves.
enum Row { kToX1, kToW1, kToX2, kToW2, kRows };

/// With smooth effects a piece is at most this long per unit of 1/rate, so that the torques along the motion
/// are nearly quadratic in it.
constexpr double kSmoothReach = 0.4;

/// Steps are at most this long against the fastest rate of a smooth effect [-], and halved at most so often.
constexpr double kEffectReach = 0.25;
constexpr int kMostHalvings = 6;

/// The flow of one mode over a whole piece h of a sample, as numbers: with δ̃ = δ − sβ the distance into the
/// contact and torques M(s) = Σ M_n sⁿ (motor), L(s) (load),
///   Δx1, w1⁺, Δx2, w2⁺  =  response · (δ̃, w1, w2, M₀, L₀, M₁, L₁, M₂, L₂, D)
/// with D the amplitude of a dying torque on the motor.
template <class T>
struct StateTransition {
  bool ready = false;
  int pieces = 1;               ///< per segment, so that a piece lies within the series' reach
  T h{};                        ///< length of a piece [s]
  T inverse_h{};                ///< [1/s]
  T response[kColumns][kRows];  ///< a column holds what one quantity does to all four
};

/// Fastest rate of a mode [1/s]: dampers, and in a closed compliant contact its oscillation and damping. A
/// dying torque may be faster.
template <class T>
double flow_rate(const FlowConstants<T>& f, bool closed, bool has_load) {
  const double m1 = value_of(f.m1), m2 = value_of(f.m2);
  double rate = std::max(std::abs(value_of(f.d1_plus)), std::abs(value_of(f.d1_minus))) / m1;
  if (!has_load) return rate;
  rate = std::max(rate, value_of(f.d2) / m2);
  if (!closed || f.rigid) return rate;
  const double inverse_mass = 1.0 / m1 + 1.0 / m2;
  return rate + std::max(std::sqrt(value_of(f.k) * inverse_mass), value_of(f.c) * inverse_mass);
}

/// Column of the response: the flow that starts from one unit of the given quantity and nothing else.
template <class T>
void response_column(const FlowConstants<T>& f, const ContactMode& mode, Column column,
                     StateTransition<T>& transition) {
  DriveState<T> start;
  Forcing<T> on;
  T* const units[kColumns] = {&start.x1,    &start.w1,   &start.w2,    &on.motor[0], &on.load[0],
                              &on.motor[1], &on.load[1], &on.motor[2], &on.load[2],  &on.decaying};
  *units[column] = T(1.0);
  if (f.rigid && mode.contact != 0 && column == kW2) return;  // one body: the load's speed is the motor's
  PowerSeries<T> z;
  flow_series(f, mode, start, on, z);
  const DriveState<T> end = evaluate(z, transition.h);
  transition.response[column][kToX1] = end.x1 - start.x1;
  transition.response[column][kToW1] = end.w1;
  transition.response[column][kToX2] = end.x2 - start.x2;
  transition.response[column][kToW2] = end.w2;
}

/// What a dying torque does over a piece that is long against it: several short pieces, put together.
template <class T>
void dying_column(const FlowConstants<T>& f, const ContactMode& mode, bool has_load,
                  StateTransition<T>& transition) {
  const double rate = std::max(flow_rate(f, mode.contact != 0, has_load), value_of(f.decay_rate));
  const double count = std::ceil(rate * value_of(transition.h) / kSeriesReach);
  if (count <= 1.0) return response_column(f, mode, kDying, transition);
  StateTransition<T> part;
  part.h = transition.h / count;
  for (auto& responses : part.response)
    for (T& r : responses) r = T(0.0);
  for (const Column column : {kDepth, kW1, kW2, kDying}) response_column(f, mode, column, part);
  using std::exp;
  const T share = exp(-f.decay_rate * part.h);  // of the amplitude, that a part leaves
  const auto& r = part.response;
  T(&sum)[kRows] = transition.response[kDying];
  T amplitude(1.0);
  for (double n = 0.0; n < count; n += 1.0) {
    const T depth = sum[kToX1] - sum[kToX2], w1 = sum[kToW1], w2 = sum[kToW2];
    for (int i = 0; i < kRows; ++i) {
      const T moved = r[kDepth][i] * depth + r[kW1][i] * w1 + r[kW2][i] * w2 + r[kDying][i] * amplitude;
      sum[i] = i % 2 == 0 ? T(sum[i] + moved) : moved;
    }
    amplitude *= share;
  }
}

/// @param span length of the segment of a sample that the transition is for [s]
/// @param halvings how often the pieces are halved beyond what the flow itself needs
template <class T>
void prepare(const FlowConstants<T>& f, const ContactMode& mode, bool has_load, const T& span, bool smooth,
             int halvings, StateTransition<T>& transition) {
  const double rate = flow_rate(f, mode.contact != 0, has_load);
  transition.pieces = std::max(
      1, static_cast<int>(std::ceil(rate * value_of(span) / (smooth ? kSmoothReach : kSeriesReach))));
  transition.pieces <<= halvings;
  transition.h = span / static_cast<double>(transition.pieces);
  if (smooth && value_of(transition.h) > 0.0) transition.inverse_h = 1.0 / transition.h;
  for (auto& responses : transition.response)
    for (T& r : responses) r = T(0.0);
  for (int column = kDepth; column < (smooth ? kDying : kMotor1); ++column)
    response_column(f, mode, static_cast<Column>(column), transition);
  if (value_of(f.decay_rate) > 0.0) dying_column(f, mode, has_load, transition);
  transition.ready = true;
}

/// φ_k(z) = Σ zⁿ/(n + k)! for k = 0 to 4: integrals of an exponential against powers. For |z| up to the
/// series' reach.
template <class T>
void exponential_integrals(const T& z, T (&phi)[5]) {
  T sum(kReciprocal[kSeriesOrder]);
  for (int n = kSeriesOrder - 1; n > 4; --n) sum = kReciprocal[n] * (1.0 + z * sum);
  phi[4] = (1.0 + z * sum) / 24.0;
  phi[3] = 1.0 / 6.0 + z * phi[4];
  phi[2] = 0.5 + z * phi[3];
  phi[1] = 1.0 + z * phi[2];
  phi[0] = 1.0 + z * phi[1];
}

/// The same for one body, for which it costs less than a step along its series: a transition that is used
/// once is worth it.
/// @param effect_rate of the smooth effects [1/s]
template <class T>
void prepare_body(const FlowConstants<T>& f, const ContactMode& mode, const T& span, bool smooth,
                  double effect_rate, StateTransition<T>& transition) {
  const double whole = value_of(span), reach = smooth ? kSmoothReach : kSeriesReach;
  const double of_flow = std::max(1.0, std::ceil(flow_rate(f, false, false) * whole / reach));
  const double of_effects = std::ceil(effect_rate * whole / kEffectReach);
  transition.pieces = static_cast<int>(std::clamp(of_effects, of_flow, of_flow * (1 << kMostHalvings)));
  transition.h = span / static_cast<double>(transition.pieces);
  if (smooth) transition.inverse_h = 1.0 / transition.h;
  auto& r = transition.response;
  const T& h = transition.h;
  if (mode.motor == 0) {
    r[kW1][kToX1] = h, r[kW1][kToW1] = T(1.0);
    for (const Column torque : {kMotor0, kMotor1, kMotor2}) r[torque][kToX1] = r[torque][kToW1] = T(0.0);
    return;
  }
  const T inverse_m = 1.0 / f.m1;
  T phi[5];
  exponential_integrals(T(-(mode.motor < 0 ? f.d1_minus : f.d1_plus) * inverse_m * h), phi);
  const T to_w = h * inverse_m;
  r[kW1][kToX1] = h * phi[1], r[kW1][kToW1] = phi[0];
  r[kMotor0][kToX1] = h * to_w * phi[2], r[kMotor0][kToW1] = to_w * phi[1];
  r[kMotor1][kToX1] = h * h * to_w * phi[3], r[kMotor1][kToW1] = h * to_w * phi[2];
  r[kMotor2][kToX1] = 2.0 * h * h * h * to_w * phi[4], r[kMotor2][kToW1] = 2.0 * h * h * to_w * phi[3];
}

}  // namespace gapscope::internal::simulation
