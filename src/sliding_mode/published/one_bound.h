#pragma once

#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// The published method, improved: one e_x with the bound L [rad/s²] reads all recordings.
/// @param facts  one per recording
GapEstimate read_recordings_with_bound(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts, double bound);

/// Steps S1 to S6 as printed and nothing else: the mean over all passages, and their scatter.
/// @param facts  one per recording
GapEstimate read_recordings_as_printed(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts, double bound);

/// Bounds of the bank's grid with which one e_x reads these recordings, for who gave one that does not: to be
/// added to its reason. Empty where none does.
Remark bounds_to_try(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts);

}  // namespace gapscope::internal::sliding_mode
