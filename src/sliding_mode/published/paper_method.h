#pragma once

#include <span>
#include <string>
#include <vector>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// What one error signal e_x (one bound; forward Euler is the source's practice) shows of steps S2 to S4.
struct PaperReading {
  double bound = 0.0;            ///< L [rad/s²]
  std::vector<GapEvent> events;  ///< passages, accepted or not
  std::vector<double> lateness;  ///< |x1(t1) − x1(reversal)| of the accepted ones [rad]
  std::vector<double> steps;     ///< |x1| covered in one sample at t2 [rad]
  double quiet = 0.0;            ///< share of samples within twice the floor
  std::size_t restless = 0;      ///< excursions that began before the reversal of x1 and show no bend at it
};

PaperReading read_with_bound(const MotorTrace& trace, const signals::SignalFacts& facts, double bound,
                             Discretisation discretisation = Discretisation::kForwardEuler);

/// Steps S5 and S6 over all recordings: |x1(t2) − x1(t1)|, averaged robustly over passages of both
/// directions.
GapEstimate decide_with_bound(std::span<const signals::SignalFacts> facts,
                              std::span<const PaperReading> readings);

}  // namespace gapscope::internal::sliding_mode
