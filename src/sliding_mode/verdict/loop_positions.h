#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/torque_cycles.h"

namespace gapscope::internal::sliding_mode {

/// The torque on its way through zero, between one extreme and the next: the samples whose u cannot be told
/// from zero.
struct ZeroPassage {
  bool rising = false;
  double amplitude = 0.0;    ///< largest |u| of the half cycle before it, which x1 remembers [unit of u]
  double time = 0.0;         ///< of the zero [s]
  double x1 = 0.0;           ///< at zero torque, of this passage alone [rad]
  std::vector<double> u, x;  ///< its samples [unit of u], [rad]
};

/// The passages of one recording in time. Where the recording ends with u at zero, its last ramp counts as
/// well: x1 stands where that ramp left it.
std::vector<ZeroPassage> zero_passages(const MotorTrace& trace, const signals::TorqueCycles& cycles);

/// What the passages of one torque level in one recording tell.
struct LoopReading {
  double lost_motion =
      0.0;                  ///< x1 at zero torque after ramps of positive u, less that after negative u [rad]
  double half_width = 0.0;  ///< of its 95 % interval [rad]
  int ramps = 0;            ///< passages that it was read from
};

/// Per direction one straight line x1(u) through the samples of all ramps, least absolute deviations, at
/// u = 0; the difference of both. The interval is Student's t of the scatter of the single ramps (1.2533
/// σ/√n: a median), or what the counts of the encoder leave, quantum/√12 on either side, where that is more.
/// Both directions must be among the passages.
LoopReading read_loop(std::span<const ZeroPassage* const> passages, double quantum);

}  // namespace gapscope::internal::sliding_mode
