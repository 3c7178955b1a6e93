#pragma once

#include <span>
#include <vector>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/folding.h"
#include "sliding_mode/transition.h"

/// How the passages that were found are told beside the recording.
namespace gapscope::internal::sliding_mode {

/// A passage as it is told: without t1 where the release was not found.
GapEvent event_of(const Transition& passage);

/// Of a mean period that was laid end to end: the passages of the second copy (what comes before the first is
/// unknown to the bank), each told in the middle one of the periods, on x1 as it was recorded.
/// @param passages  of the copies, x1 less the means that folding took off
std::vector<GapEvent> events_of_mean(const signals::FoldedMotion& folded,
                                     std::span<const Transition> passages);

}  // namespace gapscope::internal::sliding_mode
