#pragma once

#include <cstddef>

namespace gapscope::internal::sliding_mode {

struct TransitionContext;
struct Reversal;

/// Whether the motor may have come to the rest that a passage begins from by itself, within the gap: a load
/// that goes on farther has then left it before, and the way from the rest to the impact is no gap. That it
/// rests at its load is shown by a torque that pushes it there without moving it, or by an arrival that the
/// law of the free motor cannot follow.
/// @param begin  the flight, as it was read, with samples of the motor alone from there to `core`
bool may_rest_alone(const TransitionContext& context, const Reversal& reversal, std::size_t begin,
                    std::size_t core);

}  // namespace gapscope::internal::sliding_mode
