#pragma once

#include <span>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// What the recordings show at first sight, as one body: the momentum balance
///   M w + D x + F ∫sign(w) dt + B t + C (+ K ∫ known dt) = ∫ u dt
/// solved by least squares, so nothing is differentiated twice. In units of u; for starting points only. It
/// reads u and x1 alone, but M, D and F are those of a drive: nothing for a detector that knows of none.
struct OneBody {
  double inertia = 0.0;   ///< M, of motor and load together [unit of u s²/rad]
  double damping = 0.0;   ///< D [unit of u s/rad]
  double friction = 0.0;  ///< F [unit of u]
  double known = 0.0;     ///< K, that it takes for a torque known in N m [unit of u/(N m)]
  double travel = 0.0;    ///< of x1, peak to peak, largest recording [rad]
  /// Of x1 beside the straight line that it follows best, from one reversal to the next, median of all
  /// recordings; what stands has the travel [rad]
  double stroke = 0.0;
  double speed = 0.0;       ///< rms of w1 [rad/s]
  double peak_speed = 0.0;  ///< largest |w1| [rad/s]
  double peak_input = 0.0;  ///< [unit of u]
  /// Rms of what M w says beyond all other terms, over the rms of what the balance leaves [-]
  double inertia_over_left = 0.0;
};

OneBody as_one_body(std::span<const MotorTrace> recordings);

/// The same beside a torque that is known in N m: with K it tells the scale of u.
/// @param known what the motor brings against it, of each sample of each recording [N m]
OneBody as_one_body(std::span<const MotorTrace> recordings, std::span<const std::vector<double>> known);

/// An arm that hangs on the axis, read off the same balance beside A sin x1 + B cos x1 = G sin(x1 − x0).
struct HangingArm {
  double angle = 0.0;    ///< x0, where it hangs, of −π to π [rad]
  double gravity = 0.0;  ///< G > 0 [unit of u]
  double inertia = 0.0;  ///< M of that balance; below zero: u has the other sign, and x0 is that of the top
  double left = 1.0;     ///< what the balance leaves, over what it leaves without gravity, squares [-]
};

HangingArm hanging_arm(const MotorTrace& recording);

}  // namespace gapscope::internal::signals
