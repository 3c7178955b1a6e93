#pragma once

#include "gapscope/base/statistics.h"
#include "gapscope/plant/drive.h"

namespace gapscope {

/// What the paper's bound needs beside the drive.
struct BoundKnowledge {
  double input_limit = 0.0;       ///< Umax [unit of u]
  double load_force_bound = 0.0;  ///< G, bound of the unknown forces on either side [N m]
};

/// Largest motor acceleration without perturbation, eq. (11): Umax Km / m1 [rad/s²].
double motor_acceleration_bound(const DriveParameters<double>& drive, double input_limit);

/// Largest acceleration in engagement, eq. (12) [rad/s²].
double engagement_acceleration_bound(const DriveParameters<double>& drive, const BoundKnowledge& known);

/// The interval that eq. (13) recommends for L [rad/s²]:
///   (Umax Km + G)/m1 < L < (|α| Umax Km + (1 − α)(Umax Km + 2G)) / (m1 (1 − α)),   α = −m2/m1
/// It is the worst case over all frequencies of the input; at one excitation frequency the accelerations of
/// either mode are smaller and further apart.
Interval acceleration_bound(const DriveParameters<double>& drive, const BoundKnowledge& known);

/// The single value taken from (13) where one is needed: its lower end plus 5 % of its width [rad/s²].
double chosen_bound(const Interval& bound);

}  // namespace gapscope
