#pragma once

#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/passage/passage.h"

namespace gapscope::internal::sliding_mode {

/// Passages in which the load moves, read again with what the engaged flank tells of it. Motor and load
/// together obey
///   ẍ = b'·u − a'·ẋ − f'
/// until contact is lost, the motor alone ẍ1 = b·u − a·ẋ1 − f after it. b/b' − 1 is the ratio μ of the
/// inertias, and the load alone slows down by ((1 + μ)(f' + a'·w) − (f + a·w))/μ: its friction and its speed
/// at t1 are both measured, and so is its travel to t2. Only where the engaged law holds until t1 within the
/// noise: a contact that still rings then was lost in a rebound, and its two sides share no speed.
/// Else the travel is in doubt by a share of itself.
/// @param passages  of one recording, in their order
void read_coasting(const MotorTrace& trace, const signals::SignalFacts& facts,
                   std::vector<Passage>& passages);

}  // namespace gapscope::internal::sliding_mode
