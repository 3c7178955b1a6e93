#pragma once

#include "simulation/stepper_impl.h"

namespace gapscope::internal::simulation {

/// A sample of its own length.
template <class T>
void StepperImpl<T>::step(const T& u, double span) {
  begin(u);
  if (delayed)
    delayed_inputs(u, span);
  else
    uneven_segment(T(span), u);
  end();
}

/// The inputs that act within the span, each from its own time plus the delay.
template <class T>
void StepperImpl<T>::delayed_inputs(const T& u, double span) {
  GAPSCOPE_REQUIRE(!given.empty());
  newest = (newest + 1) % inputs.size();
  if (newest == acting) acting = (acting + 1) % inputs.size();
  inputs[newest] = u, given[newest] = clock;
  T done(0.0);
  while (acting != newest) {
    const std::size_t next = (acting + 1) % inputs.size();
    const T begins = given[next] - clock + delay;
    if (value_of(begins) >= span) break;
    if (value_of(begins) > value_of(done)) {
      uneven_segment(begins - done, inputs[acting]);
      done = begins;
    }
    acting = next;
  }
  uneven_segment(span - done, inputs[acting]);
  clock += span;
}

/// Any length of constant input. An inertia that changes is that of the middle of a piece, none longer than
/// the mean step.
template <class T>
void StepperImpl<T>::uneven_segment(const T& span, const T& u) {
  set_input(u);
  resolve_at_input_change();
  if (!varies_inertia) return flow_for(span);
  const double pieces = std::max(1.0, std::ceil(value_of(span) / dt));
  const T piece = span / pieces;
  for (double i = 0.0; i < pieces; i += 1.0) {
    set_inertia(value_of(piece));
    flow_for(piece);
  }
}

/// One body moves by closed form; what has a contact, or a dying torque, along its series.
template <class T>
void StepperImpl<T>::flow_for(const T& span) {
  if (has_load || decaying >= 0 || !(value_of(span) > 0.0)) return advance(span);
  prepare_body(f, mode, span, smooth, smooth ? effect_rate() : 0.0, own_transition);
  follow(own_transition, span);
}

}  // namespace gapscope::internal::simulation
