#pragma once

#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// L of the e_x that figures show where a bank of bounds has read [rad/s²]: the smallest of the bank that
/// slides just before t1, so that e_x is at rest while engaged and leaves zero with the contact. Which gap a
/// bound would read is not looked at. Without accepted passages it is the smallest that slides over the whole
/// recording. Of several recordings the median; NaN where nothing can be detected in any.
/// @param facts  one per recording
double drawn_bound(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                   std::span<const GapEvent> events);

}  // namespace gapscope::internal::sliding_mode
