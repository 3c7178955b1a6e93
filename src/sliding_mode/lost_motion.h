#pragma once

#include <optional>
#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// The lost-motion loop of gear testing: x1 against the input of a quasi-static recording (locked or very
/// heavy load, slow torque ramps), where no impact is to be seen.
///
/// A motor with dry friction Fc before a gap 2β and a contact of stiffness k moves on its rising branch along
/// (u − Fc)/k, runs free by 2β at u = Fc, and goes on along (u − Fc)/k; the falling branch mirrors it. At
/// zero torque the branches lie
///     P = 2β + 2·Fc/k
/// apart (for a ≥ 2·Fc; friction that lets less wind up adds less): the play that is read, the median over
/// the loops. Friction alone gives P = 2·Fc/k, so P is play only where x1 runs free: where it is ten times as
/// compliant as the loaded flank at the end of the ramp, for most of P. Otherwise there is no gap above the
/// smaller of P and what would have stood out, a/k at amplitude a.
///
/// Read at each torque level (loops of one amplitude, of all recordings). Levels that disagree are told, not
/// averaged. A drive that sticks and leaps once per ramp looks alike at one level; another level tells it
/// apart.
///
/// Nothing if a recording is not quasi-static, or has fewer than two loops at any level.
/// @param facts  one per recording
std::optional<GapEstimate> read_lost_motion(std::span<const MotorTrace> recordings,
                                            std::span<const signals::SignalFacts> facts);

}  // namespace gapscope::internal::sliding_mode
