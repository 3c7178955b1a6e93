#pragma once

#include "gapscope/recording/recording.h"
#include "sliding_mode/bank_run.h"
#include "sliding_mode/signal_facts.h"

namespace gapscope::internal {

/// The smallest gap whose impacts would have shown in this motion [rad]; infinite if none would.
/// An impact shows when its Δv leaves a peak 0.102 Δv²/k₂ of twice the floor at a bound above which the
/// motion itself shows nothing (`hiding`, an index: detents and stick-slip hide weaker impacts). Two
/// estimates of the speed v at which a gap g would have been closed are taken, the slower one counts: v² =
/// L_acc g, and the speed that the motor really has at the distance g from its reversals. Δv ≥ v/3 is
/// assumed: a load of at least a fifth of the motor's inertia.
double smallest_visible_gap(const MotorTrace& trace, const SignalFacts& facts, const BankRun& run,
                            std::size_t hiding);

}  // namespace gapscope::internal
