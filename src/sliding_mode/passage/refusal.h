#pragma once

#include <string>

#include "gapscope/base/remark.h"

namespace gapscope::internal::sliding_mode {

/// What every passage is asked, in this order. A passage that fails one of these tests is seen, but not used.
enum class PassageTest {
  kTurn,     ///< x1 turns round before the impact and goes farther than noise and counting feign
  kImpact,   ///< it ends in a kink against the motion that a driven motor meets, more abrupt than what was
             ///< before
  kRelease,  ///< where contact was lost is seen
  kLoad,     ///< what the load did between t1 and t2 is known
};

/// What was seen in a passage that fails a test.
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

PassageTest test_of(Refusal refusal);  ///< of a refusal that is one

/// For the remark of an event.
/// @param seen   what was measured, where the test has a number: a ratio, as the text says; else NaN
/// @param limit  what the test asks of it
std::string refusal_text(Refusal refusal, double seen, double limit);
Remark advice(Refusal refusal);  ///< what to change where it is the commonest
bool speaks_of_moving_load(Refusal refusal);
bool says_nothing(Refusal refusal);  ///< for or against a gap

}  // namespace gapscope::internal::sliding_mode
