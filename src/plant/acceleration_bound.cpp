#include "plant/acceleration_bound.h"

namespace gapscope {

double motor_acceleration_bound(const DriveParameters<double>& drive, double input_limit) {
  return input_limit * drive.torque_constant / drive.motor_inertia;
}

double engagement_acceleration_bound(const DriveParameters<double>& drive, const BoundKnowledge& known) {
  const double alpha = -drive.mass_ratio;
  const double torque = known.input_limit * drive.torque_constant;
  const double G = known.load_force_bound;
  return (-alpha * torque + (1.0 - alpha) * (torque + 2.0 * G)) / (drive.motor_inertia * (1.0 - alpha));
}

Interval acceleration_bound(const DriveParameters<double>& drive, const BoundKnowledge& known) {
  const double low =
      motor_acceleration_bound(drive, known.input_limit) + known.load_force_bound / drive.motor_inertia;
  return {low, engagement_acceleration_bound(drive, known)};
}

double chosen_bound(const Interval& bound) { return bound.low + 0.05 * (bound.high - bound.low); }

}  // namespace gapscope
