#pragma once

#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// The mean period of a periodic recording, and the same laid end to end a few times.
struct FoldedMotion {
  std::size_t periods = 0;  ///< averaged; 0: the recording cannot be folded
  double start = 0.0;       ///< of the first period used [s]
  double dt = 0.0;          ///< of the mean [s], within half a sample per period of the recording's
  double quantum = 0.0;     ///< of the encoder [rad]
  double rounding = 0.0;    ///< error that all periods share where the motion is slow: 0 with dither [rad]
  double noise = 0.0;       ///< standard deviation of a sample of the mean [rad]
  double drift = 0.0;       ///< what the motion gains from one period to the next [rad]
  std::vector<double> offsets;  ///< mean of x1 in each period used, which `mean` and the tiles lack [rad]
  std::vector<double> mean;     ///< one period of x1, its own mean removed [rad]
  /// kTiles periods, each as much farther on as the motion gains in one: a line taken off instead would make
  /// a motor that rests seem to creep, and change every way that it goes.
  std::vector<double> tiled_u, tiled_x1;

  static constexpr std::size_t kTiles = 4;
  MotorTrace trace(const std::string& file) const;
};

/// Averages the periods of x1 that repeat each other. The sampling need not be a whole fraction of the
/// period: every sample is carried to the middle of its bin along the local slope.
FoldedMotion fold(const MotorTrace& trace);

}  // namespace gapscope::internal::signals
