#pragma once

#include <optional>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// The map of |e_x| over bound and time around the passage nearest to the estimate (the middle of the
/// recording where there is none), three half periods long: the picture from which t1 and t2 can be read with
/// each bound. Nothing where the recording has no periodic motion.
/// @param facts  of this trace
std::optional<BoundMap> bound_map(const MotorTrace& trace, const signals::SignalFacts& facts,
                                  const GapEstimate& estimate);

}  // namespace gapscope::internal::sliding_mode
