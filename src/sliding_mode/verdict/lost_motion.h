#pragma once

#include <optional>
#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"
#include "sliding_mode/verdict/loop_verdict.h"

namespace gapscope::internal::sliding_mode {

/// The lost-motion loop of gear testing: x1 against the input of a quasi-static recording (locked or very
/// heavy load, slow torque ramps), where no impact is to be seen.
///
/// A motor with dry friction Fc before a gap 2β and a contact of stiffness k moves on its rising branch along
/// (u − Fc)/k, runs free by 2β at u = Fc, and goes on along (u − Fc)/k; the falling branch mirrors it. At
/// zero torque the branches lie
///     P = 2β + 2·Fc/k
/// apart (for a ≥ 2·Fc; friction that lets less wind up adds less): the lost motion. It is measured wherever
/// there is a loop, at each torque level (loops of one amplitude, of all recordings); levels that disagree
/// are told, not averaged.
///
/// Where something coasts and P reaches the whole travel, there is no flank, and no lost motion is told.
///
/// What it consists of is a second statement. A gap is passed at once, at one torque: P is mostly a gap where
/// x1 runs free, ten times as compliant as the loaded flank, for most of P, and nowhere else moves half
/// as far. Friction and compliance alone give P = 2·Fc/k without a free run, and grow with the torque. A
/// drive that sticks and leaps once per ramp looks like a gap at one level; another level tells it apart.
struct LoopSearch {
  /// Nothing where no recording has a loop.
  std::optional<LoopEvidence> found;
  bool decides = false;  ///< every recording has one, so quasi-static that no free load coasts in it
  Remark why_not;        ///< what keeps the first recording without one from it
};

/// @param facts  one per recording
LoopSearch read_lost_motion(std::span<const MotorTrace> recordings,
                            std::span<const signals::SignalFacts> facts);

/// A load that does not move cannot be told to rest: an inconclusive estimate gets a reason that speaks of
/// the loop.
void speak_of_locked_output(const LoopSearch& loops, GapEstimate& estimate);

}  // namespace gapscope::internal::sliding_mode
