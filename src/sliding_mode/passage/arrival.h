#pragma once

#include <cstddef>
#include <span>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/passage/release.h"

namespace gapscope::internal::sliding_mode {

/// A rest, and samples of the motor alone after it.
struct RestBeforeFlight {
  Reversal rest;
  std::size_t begin = 0, core = 0;  ///< of the flight
};

/// Where the motor was when it rested before a passage.
enum class RestingPlace {
  kNowhere,  ///< it did not rest: it turned round, or went on
  kAtLoad,   ///< in contact, where the load rested, too
  kAlone,    ///< it may have come to rest by itself, within the gap
  kUntold,   ///< it rested, and too little is recorded of how it got there
};

/// Whether the motor may have come to the rest that passages begin from by itself, within the gap: a load
/// that goes on farther has then left it before, and the way from the rest to the impact is no gap. That it
/// rests at its load is shown by a torque that pushes it there beyond its own dry friction without moving it,
/// or by an arrival that the law of the free motor, which the flights obey, cannot follow (unless the
/// motor's own friction can hold it there), or that no lone motor can follow which then rests at one place
/// until its flight begins there.
/// @param passages  of one kind: all rest at the load, or none does
RestingPlace resting_place(const MotorTrace& trace, const signals::SignalFacts& facts,
                           std::span<const RestBeforeFlight> passages);

}  // namespace gapscope::internal::sliding_mode
