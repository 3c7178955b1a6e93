#pragma once

#include <span>
#include <vector>

#include "sliding_mode/passage/passage.h"

namespace gapscope::internal::sliding_mode {

/// Everything that the bank of bounds found in one recording.
struct ImpactAnalysis {
  signals::SignalFacts facts;
  BankRun run;
  std::size_t marks = 0;          ///< main events
  std::vector<Passage> passages;  ///< the first main event after each change of sign
  std::size_t sliding = 0;        ///< index of L_acc, the smallest bound that slides 80 % of the time
  std::size_t deciding = 0;       ///< index of the bound that decides t2
  /// Had there been no impact: hidden by the rest of the motion or not [rad].
  double smallest_visible_gap = 0.0;
  double finest_gap = 0.0;  ///< the same where the main events are impacts, and hide nothing [rad]
  /// Smallest one that cannot hide in what one body leaves [rad]; NaN: not asked yet.
  double one_body_gap = kNaN;
};

/// @param facts  of this trace
ImpactAnalysis analyse(const MotorTrace& trace, const signals::SignalFacts& facts);

}  // namespace gapscope::internal::sliding_mode
