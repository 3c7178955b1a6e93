#pragma once

#include <cstddef>
#include <string>

#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"
#include "sliding_mode/bank_marks.h"

namespace gapscope::internal::sliding_mode {

/// Why a passage of the gap was not used, in the order in which it is tested.
enum class Refusal {
  kNone,
  kContrast,     ///< not more abrupt than the motion before it
  kNoReversal,   ///< x1 does not reverse before the impact: the load has crossed the gap
  kSmallRise,    ///< the passage is a few quanta wide
  kTorn,         ///< what looks like the impact frees the motor: the contact pulled until it tore
  kLoadHits,     ///< the motor was not moving along the gap when it was hit
  kNoImpactFit,  ///< no kink where the impact should be
  kNoRelease,    ///< neither a rest of the motor nor a separation in motion is seen before the impact
  kLoadMoving,   ///< the load's own travel is too uncertain
  kSameFlank,    ///< the flank that is hit is the one that was left: the load has only been caught up with
  kThrownOff,    ///< the impact before threw the bodies apart: they do not share a speed at t1
  kRestsAlone,   ///< the motor may have come to rest within the gap, which its load left before
  kPushed,       ///< a force drives the load through the gap, too
};

const char* refusal_text(Refusal refusal);  ///< for the remark of an event
bool speaks_of_moving_load(Refusal refusal);
Remark advice(Refusal refusal);  ///< what to change where it is the commonest

/// One candidate passage: an impact, and the release before it.
struct Transition {
  GapEvent event;
  Refusal refusal = Refusal::kNone;
  double contrast = 0.0;    ///< abruptness over what the motion before it needs
  double half_width = 0.0;  ///< systematic: where the release and the load's travel may lie [rad]
  double speed = 0.0;  ///< at which the gap closes: of the motor before the impact, less the load's [rad/s]
  double acceleration = 0.0;  ///< of the motor in the gap, just before the impact [rad/s²]
  double contact = 0.0;       ///< ω of both bodies on the spring of the contact; 0: rigid [rad/s]
  double hidden = 0.0;        ///< way of the motor before the impact shows in the noise [rad]
  double load_travel = 0.0;   ///< assumed between t1 and t2 [rad]
  bool dwell = false;         ///< the motor rested before it entered the gap
  bool by_law = false;        ///< the load's travel is by the law of the engaged flank
  double t1_first = kNaN, t1_last = kNaN;             ///< between which contact was lost [s]
  double t2_half_width = 0.0, hidden_time = 0.0;      ///< of half_width and hidden, by t2 alone [s]
  bool released() const { return half_width > 0.0; }  ///< both ends of the flight were found
};

/// What an impact is looked at with.
struct TransitionContext {
  const MotorTrace& trace;
  const signals::SignalFacts& facts;
  const BankMarks& run;
};

/// The passage that ends in `impact` and began after sample `from`.
Transition read_transition(const TransitionContext& context, const BankEvent& impact, std::size_t from);

}  // namespace gapscope::internal::sliding_mode
