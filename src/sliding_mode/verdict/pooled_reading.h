#pragma once

#include <optional>
#include <span>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/verdict/evidence.h"

namespace gapscope::internal::sliding_mode {

/// The gap that the passages of a recording show together, where each of them shows too little
/// (PooledFlights). Read only where the load rests while the torque changes its sign.
/// @param facts  one per recording
/// @returns nothing where no gap can be told
std::optional<GapEvidence> read_pooled(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts);

}  // namespace gapscope::internal::sliding_mode
