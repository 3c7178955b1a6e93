#pragma once

#include "drives/reference_motion.h"
#include "gapscope/base/statistics.h"

namespace gapscope::independent_plant {

/// A cascade of position and speed, sampled; e = w* − ŵ, ŵ the filtered difference of the readings:
///   w* = position_gain·(x* − x) + speed_forward·ẋ*,     u = speed_gain·(e + (1/integral_s)·∫e dt)
/// Without a position gain it controls speed alone, without an integral time it is P.
struct ControllerSettings {
  double rate = 1000.0;           ///< of readings and commands [Hz]
  double position_gain = 0.0;     ///< [1/s]
  double speed_forward = 1.0;     ///< share of the reference's speed that w* begins with
  double speed_gain = 0.01;       ///< [unit of u per rad/s]
  double integral_s = kInfinity;  ///< [s]
  double filter_s = 0.0;          ///< time constant of ŵ [s]
  double dead_time_s = 0.0;       ///< from a reading to its command
  double limit = kInfinity;       ///< of |u|; the integral stands still there [unit of u]
  double supply_sag = 0.0;  ///< share of the supply that a command at the limit takes: it is a duty then
  double jitter_s = 0.0;    ///< every turn late by a uniform share of it, < 1/rate
};

/// Gains for a body of this inertia.
/// @param bandwidth_hz  at which the open speed loop crosses 1
ControllerSettings tuned_controller(double inertia, double torque_constant, double bandwidth_hz, double rate);

class Controller {
 public:
  explicit Controller(const ControllerSettings& settings);

  /// Reads x at t and answers with a command.
  double step(double t, double x, const Target& target);

 private:
  ControllerSettings settings_;
  double last_t_ = kNaN, last_x_ = 0.0, speed_ = 0.0, integral_ = 0.0;
};

}  // namespace gapscope::independent_plant
