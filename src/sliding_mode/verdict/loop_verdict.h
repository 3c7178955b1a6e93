#pragma once

#include <span>

#include "base/normal.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "sliding_mode/verdict/evidence.h"
#include "sliding_mode/verdict/loop_positions.h"
#include "sliding_mode/verdict/loop_shape.h"

namespace gapscope::internal::sliding_mode {

constexpr double kSurely = kNormal95;  ///< standard errors to either side: 95 %

/// What the loops of one torque amplitude say.
struct TorqueLevel {
  double amplitude = 0.0;   ///< [unit of u]
  double resolution = 0.0;  ///< of one position [rad]
  LoopReading reading;
  LoopShape shape;
  double play() const { return reading.lost_motion; }
  double std() const { return reading.half_width / kSurely; }
  bool runs() const;            ///< x1 runs free on each ramp, at one torque, over most of P
  bool shows_play() const;      ///< the same over no more than P, and P is known
  bool leaps() const;           ///< x1 runs free over more than P
  bool runs_nowhere() const;    ///< x1 runs free over next to nothing of P
  bool runs_free() const;       ///< as far as a gap that would have stood out: it stood out
  bool runs_backwards() const;  ///< friction and gaps lag behind u; only a u that is late itself leads
};

/// A lost motion of which a gap that was read otherwise is the smaller part is not mostly a gap: it is told
/// by these two numbers.
void hold_against_gap(GapEstimate& estimate);

/// Lost motion and what it means, and what it says of a gap.
struct LoopEvidence {
  LostMotion lost_motion;
  GapEvidence evidence;  ///< of an output that is declared not to move
  /// The same of one that may: a load whose friction is near the torque makes such a loop as well, with the
  /// way that it slides in it. A play at one level is then an upper bound, and two levels that agree a gap.
  GapEvidence undeclared() const;
};

/// @param levels  at least one, by rising torque
LoopEvidence loop_evidence(std::span<const TorqueLevel> levels);

}  // namespace gapscope::internal::sliding_mode
