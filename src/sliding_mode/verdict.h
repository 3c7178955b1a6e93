#pragma once

#include <span>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "sliding_mode/impact_method.h"

namespace gapscope::internal::sliding_mode {

/// Verdict, estimate and events from all recordings together. Median per direction, mean of both.
/// @param intervals  sampling interval of each [s]
GapEstimate decide_gap(std::span<const ImpactAnalysis> analyses, std::span<const double> intervals);

}  // namespace gapscope::internal::sliding_mode
