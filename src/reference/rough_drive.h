#pragma once

#include <span>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::reference {

/// What the recordings show at first sight, as one body: the momentum balance
///   M w + D x + F ∫sign(w) dt + B t + C = ∫ u dt
/// solved by least squares, so nothing is differentiated twice. In units of u; for starting points only.
struct RoughDrive {
  double inertia = 0.0;     ///< M, of motor and load together [unit of u s²/rad]
  double damping = 0.0;     ///< D [unit of u s/rad]
  double friction = 0.0;    ///< F [unit of u]
  double travel = 0.0;      ///< of x1, peak to peak, largest recording [rad]
  double speed = 0.0;       ///< rms of w1 [rad/s]
  double peak_speed = 0.0;  ///< largest |w1| [rad/s]
  double peak_input = 0.0;  ///< [unit of u]
};

RoughDrive rough_drive(std::span<const MotorTrace> recordings);

/// Position and speed at the first sample, with the speed's standard error, from a cubic over as many
/// samples as one fits.
struct LocalMotion {
  double x = 0.0, w = 0.0, w_std = 0.0;
};
LocalMotion local_motion(const MotorTrace& recording, double floor);

/// What the encoder alone leaves: quantum/√12, or what the fourth differences show if that is larger [rad].
double encoder_floor(const MotorTrace& recording);

}  // namespace gapscope::internal::reference
