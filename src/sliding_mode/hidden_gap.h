#pragma once

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/free_body.h"

namespace gapscope::internal::sliding_mode {

/// Of the motor's inertia: the lightest load for which a gap is denied by what the law of one body leaves.
/// Half of it tells 14 of 5640401 40 gap_free sine wide that there is none, this 18, 0.3 20; of 5650001 60
/// gap sine wide slides it denies 1, 1 and 7 above the limit that is told.
inline constexpr double kLightestLoad = 0.2;

/// How well a recording is explained by motor and load as one body.
struct OneBodyFit {
  FreeBody law;
  double left = kInfinity;    ///< what it leaves of its periods, FollowedBody::left [rad]
  double hidden = kInfinity;  ///< gap of a load of kLightestLoad that would have left as much [rad]
};

/// The body that leaves least of the periods, from one crossing of the centre to the next but one, each at
/// 400 instants: u is the mean up to the next one, x1 that of the samples around it. Begun at the
/// accelerations that smoothed positions show, without and with friction that fades with speed.
/// @returns left = infinity where no period is seen, or the input drives nothing
OneBodyFit fit_one_body(const MotorTrace& trace, const signals::SignalFacts& facts);

}  // namespace gapscope::internal::sliding_mode
