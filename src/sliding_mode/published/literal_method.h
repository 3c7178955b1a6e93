#pragma once

#include <span>
#include <vector>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// Steps S2 to S5 of the source paper as printed, on the e_x of one bound L [rad/s²] by forward Euler, begun
/// at the first sample and at no speed. Of each passage t1, t2, x1 there and |x1(t2) − x1(t1)|; no interval.
/// @param facts  of this trace, in which something can be detected
std::vector<GapEvent> passages_as_printed(const MotorTrace& trace, const signals::SignalFacts& facts,
                                          double bound);

/// Step S6: the mean of all passages; `std` is their scatter, and nothing else is claimed.
/// @param facts, passages  one per recording
GapEstimate mean_as_printed(std::span<const signals::SignalFacts> facts,
                            std::span<const std::vector<GapEvent>> passages, double bound);

}  // namespace gapscope::internal::sliding_mode
