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

/// How well one body explains a recording.
struct OneBodyFit {
  OneBodyLaw law;
  double left = kInfinity;  ///< rms of x1 less its motion, in means over 1/80 of a period [rad]
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
