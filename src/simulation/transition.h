#pragma once

#include <algorithm>
#include <cmath>

#include "simulation/series.h"

namespace gapscope::internal {

/// The flow of one mode over a whole piece h of a sample, as numbers: with δ̃ = δ − sβ the distance into the
/// contact and constant torques M (motor), L (load),
///   Δx1, w1⁺, Δx2, w2⁺  =  response · (δ̃, w1, w2, M, L).
template <class T>
struct Transition {
  bool ready = false;
  int pieces = 1;  ///< per sample, so that a piece lies within the series' reach
  double h = 0.0;  ///< length of a piece [s]
  T response[4][5];
};

/// Fastest rate of a mode [1/s]: dampers, and in a closed compliant contact its oscillation and damping.
template <class T>
double flow_rate(const FlowConstants<T>& f, bool closed, bool has_load) {
  const double m1 = value_of(f.m1), m2 = value_of(f.m2);
  double rate = std::max(value_of(f.d1_plus), value_of(f.d1_minus)) / m1;
  if (!has_load) return rate;
  rate = std::max(rate, value_of(f.d2) / m2);
  if (!closed || f.rigid) return rate;
  const double inverse_mass = 1.0 / m1 + 1.0 / m2;
  return rate + std::max(std::sqrt(value_of(f.k) * inverse_mass), value_of(f.c) * inverse_mass);
}

/// Column of the response: the flow that starts from one unit of the given quantity and nothing else.
template <class T>
void response_column(const FlowConstants<T>& f, const ContactMode& mode, int column, double h,
                     Transition<T>& transition) {
  DriveState<T> start;
  Forcing<T> on;
  T* const units[5] = {&start.x1, &start.w1, &start.w2, &on.motor[0], &on.load[0]};
  *units[column] = T(1.0);
  if (f.rigid && mode.contact != 0 && column == 2) return;  // one body: the load's speed is the motor's
  Series<T> z;
  flow_series(f, mode, start, on, z);
  const DriveState<T> end = evaluate(z, T(h));
  transition.response[0][column] = end.x1 - start.x1;
  transition.response[1][column] = end.w1;
  transition.response[2][column] = end.x2 - start.x2;
  transition.response[3][column] = end.w2;
}

template <class T>
void prepare(const FlowConstants<T>& f, const ContactMode& mode, bool has_load, double dt,
             Transition<T>& transition) {
  const double rate = flow_rate(f, mode.contact != 0, has_load);
  transition.pieces = std::max(1, static_cast<int>(std::ceil(rate * dt / kSeriesReach)));
  transition.h = dt / transition.pieces;
  for (auto& row : transition.response)
    for (T& r : row) r = T(0.0);
  for (int column = 0; column < 5; ++column) response_column(f, mode, column, transition.h, transition);
  transition.ready = true;
}

}  // namespace gapscope::internal
