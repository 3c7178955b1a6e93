#pragma once

#include <optional>
#include <span>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/verdict/evidence.h"

namespace gapscope::internal::sliding_mode {

constexpr double kSameShelf = 0.15;  ///< of the way: two windows tell the same; half and double tell the same

/// The reversal shelf: where a drive goes slowly to and fro, such as in a position loop, the torque behind a
/// reversal stays on a shelf as long as the motor moves alone, against its own friction, and rises by that of
/// the load where it meets the far flank. The way between is the gap, without any impact.
///
/// Along the motion, over the way s since x1 turned round, the torque is read as two levels. That they are
/// levels, in both directions and in windows of several lengths, is what tells a shelf from a torque that
/// accelerates, winds up a spring or follows the place. On the way of w where a spring is wound up to the
/// load's friction the torque rises, and at the turn it unwinds by as much: the rise is half done at
/// s = gap + 1.5 w.
/// @param facts  one per recording
/// @returns nothing where there is no shelf
std::optional<GapEvidence> read_shelf(std::span<const MotorTrace> recordings,
                                      std::span<const signals::SignalFacts> facts);

}  // namespace gapscope::internal::sliding_mode
