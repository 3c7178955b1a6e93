#pragma once

#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::implant {

/// Where a drive was at one time.
struct MotionPoint {
  double t = 0.0;  ///< since the first sample [s]
  double x = 0.0;  ///< [rad]
  double w = 0.0;  ///< [rad/s]
  double a = 0.0;  ///< [rad/s²]
};

/// The motion behind the readings of an encoder: a fixed-interval smoother (Rauch, Tung and Striebel) of
/// three integrators driven by white jerk, whose intensity over that of the readings' noise is the one under
/// which the readings are most likely. No estimator of gapscope reads speeds by it.
class SmoothedMotion {
 public:
  /// @param trace of at least 3 samples, evenly sampled or not
  explicit SmoothedMotion(const MotorTrace& trace);

  std::size_t size() const { return points_.size(); }
  const MotionPoint& at(std::size_t i) const { return points_[i]; }
  /// Between sample i and the next by the polynomial of degree 5 that has position, speed and acceleration of
  /// both. @param share of the way, 0 to 1; beyond the last sample as at constant acceleration
  MotionPoint between(std::size_t i, double share) const;
  double step(std::size_t i) const;  ///< to the next sample; of the last one the mean step [s]
  double speed_std(std::size_t i) const { return speed_std_[i]; }  ///< of the smoothed speed [rad/s]
  /// Sign of the speed; 0 where it is within three standard deviations of none: the drive stands.
  int direction(std::size_t i, const MotionPoint& at) const;

 private:
  std::vector<MotionPoint> points_;
  std::vector<double> speed_std_;
  double mean_step_ = 0.0;
};

}  // namespace gapscope::internal::implant
