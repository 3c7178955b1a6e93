#pragma once

#include "simulation/stepper_outlook.h"

namespace gapscope::internal::simulation {

template <class T>
StateTransition<T>& StepperImpl<T>::transition(const T& span, int index, int times_halved) {
  StateTransition<T>& found = transitions[index][flow_index(mode, model.gears_rub)][times_halved];
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
    next.x1 = z.x1 + r[kW1][kToX1] * z.w1 + r[kMotor0][kToX1] * on.motor[0];
    next.w1 = r[kW1][kToW1] * z.w1 + r[kMotor0][kToW1] * on.motor[0];
    if (decaying >= 0) {
      next.x1 += r[kDying][kToX1] * on.decaying;
      next.w1 += r[kDying][kToW1] * on.decaying;
    }
    if (!has_load || mode.load == 0) {
      next.x2 = z.x2, next.w2 = z.w2;
      return;
    }
    next.x2 = z.x2 + r[kW2][kToX2] * z.w2 + r[kLoad0][kToX2] * on.load[0];
    next.w2 = r[kW2][kToW2] * z.w2 + r[kLoad0][kToW2] * on.load[0];
    return;
  }
  const T depth = z.x1 - z.x2 - static_cast<double>(mode.contact) * on.half_gap[0];
  T out[kRows];
  for (int i = 0; i < kRows; ++i)
    out[i] = r[kDepth][i] * depth + r[kW1][i] * z.w1 + r[kW2][i] * z.w2 + r[kMotor0][i] * on.motor[0] +
             r[kLoad0][i] * on.load[0];
  if (decaying >= 0)
    for (int i = 0; i < kRows; ++i) out[i] += r[kDying][i] * on.decaying;
  next = {z.x1 + out[kToX1], out[kToW1], z.x2 + out[kToX2], out[kToW2]};
}

/// What a contact has beyond its spring and damper acts on both sides, as torques do.
template <class T>
Forcing<T> StepperImpl<T>::with_hardening(Forcing<T> on) const {
  on.motor[0] -= felt_share(f, mode) * on.contact[0];
  on.load[0] += on.contact[0];
  return on;
}

/// Adds what the slopes and curvatures of the torques do. A gap that opens under a closed contact pushes on
/// both bodies like a pair of torques k s β.
template <class T>
void StepperImpl<T>::respond_to_slopes(const StateTransition<T>& step, const Forcing<T>& on,
                                       DriveState<T>& next) const {
  const auto& r = step.response;
  if (mode.contact == 0) {
    next.x1 += r[kMotor1][kToX1] * on.motor[1] + r[kMotor2][kToX1] * on.motor[2];
    next.w1 += r[kMotor1][kToW1] * on.motor[1] + r[kMotor2][kToW1] * on.motor[2];
    if (!has_load || mode.load == 0) return;
    next.x2 += r[kLoad1][kToX2] * on.load[1] + r[kLoad2][kToX2] * on.load[2];
    next.w2 += r[kLoad1][kToW2] * on.load[1] + r[kLoad2][kToW2] * on.load[2];
    return;
  }
  T motor[2] = {on.motor[1], on.motor[2]}, load[2] = {on.load[1], on.load[2]};
  if ((moves_gap && !f.rigid) || f.hardens) {
    const T pushing = static_cast<double>(mode.contact) * f.k, felt = felt_share(f, mode);
    for (int n = 0; n < 2; ++n) {
      const T beyond = on.contact[n + 1] - pushing * on.half_gap[n + 1];
      motor[n] -= felt * beyond;
      load[n] += beyond;
    }
  }
  T* const out[kRows] = {&next.x1, &next.w1, &next.x2, &next.w2};
  for (int i = 0; i < kRows; ++i)
    *out[i] +=
        r[kMotor1][i] * motor[0] + r[kLoad1][i] * load[0] + r[kMotor2][i] * motor[1] + r[kLoad2][i] * load[1];
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
  if (f.hardens && mode.contact != 0)
    respond(step, with_hardening(on), next);
  else
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

template <class T>
void StepperImpl<T>::accept(const DriveState<T>& next, const T& h) {
  if (smooth) ++smooth_pieces;
  if (remembers) advance_memory(next, now + h);
  z = next;
  now += h;
}

/// The first input acted before it was given, too.
template <class T>
void StepperImpl<T>::begin(const T& u) {
  closed = false;
  if (started) return;
  std::fill(inputs.begin(), inputs.end(), u);
  set_input(u);
  remember_start();
  started = true;
  acting = newest;
  clock = 0.0;
}

template <class T>
void StepperImpl<T>::end() {
  const double sum = value_of(z.x1) + value_of(z.w1) + value_of(z.x2) + value_of(z.w2);
  if (!(std::abs(sum) < 1e12)) healthy = false;
}

template <class T>
void StepperImpl<T>::step(const T& u) {
  begin(u);
  if (varies_inertia) set_inertia(dt);
  if (delayed) {
    GAPSCOPE_REQUIRE(given.empty());
    newest = (newest + 1) % inputs.size();
    inputs[newest] = u;
    const std::size_t oldest = (newest + 1) % inputs.size();
    segment(delay_rest, inputs[oldest], 0);
    segment(dt - delay_rest, inputs[(oldest + 1) % inputs.size()], 1);
  } else {
    segment(T(dt), u, 0);
  }
  end();
}

/// Part of a sample in which the input is constant.
template <class T>
void StepperImpl<T>::segment(const T& span, const T& u, int index) {
  set_input(u);
  resolve_at_input_change();
  const StateTransition<T>* whole = &transition(span, index, 0);
  if (smooth) whole = &transition(span, index, halvings(value_of(whole->h)));
  follow(*whole, span);
}

/// Piece by piece, all of one transition, up to the first that an event may lie in: from there exactly.
template <class T>
void StepperImpl<T>::follow(const StateTransition<T>& whole, const T& span) {
  DriveState<T> next;
  Forcing<T> on = forcing_without_effects();
  Acting at_start{value_of(on.half_gap[0]), 0.0, value_of(on.motor[0]), 0.0, value_of(on.load[0]), 0.0};
  Acting at_end = at_start;
  for (int piece = 0; piece < whole.pieces; ++piece) {
    if (smooth) {
      on = forcing_without_effects();
      advance_smoothly(whole, on, next);
      at_start = acting_at(*this, on, 0.0), at_end = acting_at(*this, on, value_of(whole.h));
    } else if (decaying >= 0) {
      on = forcing_without_effects();
      respond(whole, on, next);
      at_start = acting_at(*this, on, 0.0), at_end = acting_at(*this, on, value_of(whole.h));
    } else {
      respond(whole, on, next);
    }
    if (may_leave(next, at_start, at_end, value_of(whole.h))) {
      advance(span - static_cast<double>(piece) * whole.h);
      return;
    }
    accept(next, whole.h);
    forget_zeros();
  }
}

/// The flow over h as a series, smooth effects as the quadratic along it.
template <class T>
void StepperImpl<T>::build_series(const T& h, int rough_order, PowerSeries<T>& series, Forcing<T>& on) const {
  on = forcing_without_effects();
  if (!smooth) return flow_series(f, mode, z, on, series);
  const Extra<T> start = extra_at(z, now);
  add_constant(on, start);
  if (value_of(h) <= 0.0) return flow_series(f, mode, z, on, series);
  const int whole = series.order;
  series.order = std::min(whole, rough_order);
  flow_series(f, mode, z, on, series);
  const T inverse_h = 1.0 / h;
  for (int pass = 0; pass < kCorrections; ++pass) {
    const DriveState<T> next = evaluate(series, h);
    const DriveState<T> middle = middle_between(z, next, h, inverse_h);
    bend(on, start, extra_at(middle, now + 0.5 * h), extra_at(next, now + h), inverse_h);
    if (pass + 1 == kCorrections) series.order = whole;
    flow_series(f, mode, z, on, series);
  }
}

/// The exact path: Taylor series of the running mode up to its first event, then on in the next mode.
template <class T>
void StepperImpl<T>::advance(T span) {
  const double least = 1e-13 * dt, most = kMostEventsPerSample * std::max(1.0, value_of(span) / dt);
  PowerSeries<T> series;
  Forcing<T> on;
  for (int count = 0;; ++count) {
    if (count > most) {
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
    build_series(h, series_order(rate * value_of(h), kRough), series, on);
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
