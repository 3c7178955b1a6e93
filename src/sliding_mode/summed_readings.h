#pragma once

#include <span>
#include <vector>

#include "sliding_mode/impact_method.h"

namespace gapscope::internal::sliding_mode {

/// Where samples and periods one by one show too little of the impacts, what sums of them show: the mean
/// period, then means of a few samples each, then the mean period of these. The first that gives a gap takes
/// the place of `estimate` and `analyses`.
/// @param facts  one per recording
void read_sums(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
               std::vector<ImpactAnalysis>& analyses, GapEstimate& estimate);

}  // namespace gapscope::internal::sliding_mode
