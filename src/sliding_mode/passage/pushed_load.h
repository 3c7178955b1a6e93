#pragma once

#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/passage/passage.h"

namespace gapscope::internal::sliding_mode {

/// Refuses passages whose load does not rest when the motor leaves it, since a force that depends on where
/// the load is (an unbalance, a spring) exceeds its dry friction there and drives it through the gap, too.
/// Motor and load together obey
///   ẍ = b'·u − a'·ẋ − f'·sign(ẋ) + g(x),      g a polynomial of the third order,
/// from the impact before, once its bounces have faded, to where x1 turns round; the same numbers in all
/// strokes, fitted in integrated form. A passage in direction d from a turn at x begins with a moving load
/// where d·g(x) > f'. Only where a law without g(x) cannot follow the strokes: what rings, or is bent
/// otherwise, tells nothing. f' is the friction of both bodies: a motor that rubs hides as much of the push.
/// It looks at all strokes of a recording together: the detector of a stream does not have it.
/// @param passages  of one recording, in their order
void refuse_pushed_loads(const MotorTrace& trace, const signals::SignalFacts& facts,
                         std::vector<Passage>& passages);

}  // namespace gapscope::internal::sliding_mode
