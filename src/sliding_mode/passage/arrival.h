#pragma once

#include <cstddef>
#include <span>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/passage/release.h"

namespace gapscope::internal::sliding_mode {

/// Of a way: by how much the motor's own friction may be none of dry and viscous alone, which bends and
/// creeps where a dry one holds. On drives with LuGre friction whose load bounced off before the rest it
/// leaves 0.015 to 0.03 of the arrival, a contact 0.07 to 0.4.
constexpr double kOwnBending = 0.05;

/// A rest or a turn, and samples of the motor alone after it.
struct RestBeforeFlight {
  Reversal rest;
  std::size_t begin = 0, core = 0;  ///< of the flight
};

/// Where the motor was when it came to rest, or turned round, before a passage.
enum class RestingPlace {
  kAtLoad,  ///< in contact, where the load rested, too
  kAlone,   ///< by itself, within the gap
  kUntold,  ///< one or the other: too little is recorded, or what the motor's own friction may do as well
};

/// Whether the motor may have come to its rest by itself, within the gap: a load that goes on farther has
/// then left it before, and the way from the rest to the impact is no gap. That it rests at its load is shown
/// by a torque that pushes it there beyond its own dry friction without moving it, or by the last of its
/// arrival, which departs from the law of the free motor that the flights obey by more than its own friction
/// may. That it is alone is shown by an arrival that one law follows together with the rest and the flight.
/// @param passages  of one kind: all rest at the load, or none does
RestingPlace resting_place(const MotorTrace& trace, const signals::SignalFacts& facts,
                           std::span<const RestBeforeFlight> passages);

}  // namespace gapscope::internal::sliding_mode
