#pragma once

#include <array>

#include "simulation/series.h"

namespace gapscope::internal::simulation {

enum class GuardEvent {
  kNone,
  kOpen,    ///< contact torque falls to zero
  kClose,   ///< the contact closes on the guard's side
  kInside,  ///< an opened contact returns within the gap's edge
  kLoadStops,
  kLoadBreaks,  ///< torque on the sticking load exceeds its friction, towards the guard's side
  kMotorStops,
  kMotorBreaks,
};

/// A polynomial that is positive as long as the mode lasts.
struct Guard {
  GuardEvent event = GuardEvent::kNone;
  int side = 0;
  int order = kSeriesOrder;
  int zeros = 0;  ///< leading coefficients that are zero by construction (just after the guard's own event)
  double p[kSeriesOrder + 1] = {};
};

/// At most: contact on two sides, load on two, motor on two.
struct GuardSet {
  std::array<Guard, 6> guards;
  int count = 0;
  Guard& add(GuardEvent event, int side, int zeros);
};

struct FirstEvent {
  int guard = -1;  ///< index in the set; −1: none within the step
  double time = 0.0;
};

/// Earliest guard that falls to zero within (0, h]. Each polynomial is sampled at quarters of the step,
/// interior minima included, which is exhaustive for the nearly cubic guards of a step within the series'
/// reach.
FirstEvent first_event(const GuardSet& set, double h);

}  // namespace gapscope::internal::simulation
