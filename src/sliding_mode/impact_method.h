#pragma once

#include <functional>
#include <span>
#include <vector>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/folding.h"
#include "sliding_mode/transition.h"

namespace gapscope::internal::sliding_mode {

/// Everything that the bank of bounds found in one recording.
struct ImpactAnalysis {
  signals::SignalFacts facts;
  BankRun run;
  std::size_t marks = 0;             ///< main events
  std::vector<Transition> passages;  ///< the first main event after each change of sign
  std::size_t sliding = 0;           ///< index of L_acc, the smallest bound that slides 80 % of the time
  std::size_t deciding = 0;          ///< index of the bound that decides t2
  double smallest_visible_gap =
      0.0;                  ///< had there been no impact: hidden by the rest of the motion or not [rad]
  double finest_gap = 0.0;  ///< the same where the main events are impacts, and hide nothing [rad]
  /// Smallest one that cannot hide in what one body leaves [rad]; reads the recording when it is asked.
  std::function<double()> one_body_gap = [] { return kInfinity; };
  double quantum = 0.0;  ///< of the encoder, also where periods were averaged [rad]
  bool repeats = false;  ///< one mean period again and again: its passages are no independent witnesses
};

/// @param trace  whose samples outlive the analysis   @param facts  of this trace
ImpactAnalysis analyse(const MotorTrace& trace, const signals::SignalFacts& facts);
ImpactAnalysis analyse_mean(const signals::FoldedMotion& mean, const MotorTrace& whole);

/// Smallest gap that cannot hide in what one body leaves of any of these recordings [rad]: a law is fitted to
/// them, so only a denial asks.
double one_body_gap(std::span<const ImpactAnalysis> analyses);

}  // namespace gapscope::internal::sliding_mode
