#pragma once

#include <span>

#include "gapscope/sliding_mode/detector.h"
#include "sliding_mode/impact_search.h"
#include "sliding_mode/verdict/evidence.h"
#include "sliding_mode/verdict/lost_motion.h"

/// The door of this room: one verdict of all that was seen.
namespace gapscope::internal::sliding_mode {

/// The first that reads a gap: single passages, all passages together where the load rests at the change of
/// the torque's sign, the loop. Where none does, the loop's verdict, or a denial by the impacts.
/// @param facts, analyses  one per recording
GapEstimate decide_gap(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                       std::span<const ImpactAnalysis> analyses, const LoopSearch& loops,
                       const DetectorOptions& options);

/// @param locked  the output is declared not to move
GapEstimate decide_by_loop(const LoopSearch& loops, bool locked);

/// Single passages, or a denial, of one recording whose samples are gone.
GapEstimate decide_stream(const ImpactAnalysis& analysis, double dt);

}  // namespace gapscope::internal::sliding_mode
