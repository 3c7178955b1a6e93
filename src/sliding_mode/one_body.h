#pragma once

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// ẍ1 = drive·u + constant − viscous·ẋ1 − (dry + sticking·e^(−|ẋ1|/fading))·sign(ẋ1): motor and load as one
/// body, which stays where it came to rest while the torque is below dry + sticking.
struct OneBodyLaw {
  double drive = 0.0;     ///< [rad/s² per unit of u]
  double constant = 0.0;  ///< gravity, an offset of u [rad/s²]
  double viscous = 0.0;   ///< [1/s], at least 0
  double dry = 0.0;       ///< [rad/s²], at least 0
  double sticking = 0.0;  ///< more than that at rest; with `dry` at least 0 [rad/s²]
  double fading = 1.0;    ///< speed at which that has fallen to 1/e [rad/s]
};

/// Of the motor's inertia: the lightest load for which a gap is denied by what the law of one body leaves.
/// Half of it tells 14 of 5640401 40 gap_free sine wide that there is none, this 18, 0.3 20; of 5650001 60
/// gap sine wide slides it denies 1, 1 and 7 above the limit that is told.
inline constexpr double kLightestLoad = 0.2;

/// How well one body explains a recording.
struct OneBodyFit {
  OneBodyLaw law;
  double left = kInfinity;    ///< rms of x1 less its motion, in means over 1/80 of a period [rad]
  double hidden = kInfinity;  ///< gap of a load of kLightestLoad that would have left as much [rad]
};

/// The law of one body that leaves least squares of those means, followed freely through each period, from
/// one crossing of the centre to the next but one, with a place and a speed of its own at its begin.
/// (lone_motor_squares() asks for a motor alone, and for its way to a rest.) At most 12 periods, spread over
/// the recording, each at 400 instants: u is the mean up to the next one, x1 that of the samples around it.
/// Levenberg and Marquardt (Eigen's), begun at the accelerations that smoothed positions show, without and
/// with friction that fades with speed.
/// @returns left = infinity where no period is seen, or the input drives nothing
OneBodyFit fit_one_body(const MotorTrace& trace, const signals::SignalFacts& facts);

}  // namespace gapscope::internal::sliding_mode
