#pragma once

#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// An instant at which the input passes zero.
struct ZeroCrossing {
  std::size_t sample = 0;
  double x1 = 0.0;          ///< mean position around it [rad]
  double half_width = 0.0;  ///< half the range of x1 around it: what an error of the zero would cost [rad]
  bool rising = false;
  double before = 0.0;  ///< largest |u| of the half cycle before it [unit of u]; 0: none before
  double after = 0.0;   ///< the same of the half cycle after it
};

/// The input as half cycles between its zeros. Only u's zero counts, so its unit does not matter.
struct TorqueCycles {
  std::vector<double> u;  ///< input, its noise smoothed over a fiftieth of a half cycle [unit of u]
  std::vector<ZeroCrossing> crossings;
  double noise = 0.0;     ///< standard deviation of the noise of one u [unit of u]
  std::size_t reach = 0;  ///< the smoothing of u goes as far to either side [samples]
  /// Share of the travel of x1 that goes with the change of u: 1 where x1 is a hysteretic function of u
  /// (locked or very heavy load, slow ramps), about one half where a free load moves on while u falls.
  double following = 0.0;
};

/// Empty `crossings` where the input has no half cycles.
TorqueCycles torque_cycles(const MotorTrace& trace);

/// A branch of the loop from one extreme of the input to the next: x1 where u first passes equally spaced
/// values from −amplitude to +amplitude in the direction of the branch, counted along it. (bins + 1) values;
/// empty if the branch is cut off.
std::vector<double> branch_positions(const MotorTrace& trace, const TorqueCycles& cycles,
                                     std::size_t crossing, double amplitude, std::size_t bins);

}  // namespace gapscope::internal::signals
