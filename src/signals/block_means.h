#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::signals {

/// A recording in means of a few samples each.
struct BlockMeans {
  std::size_t width = 0;         ///< samples in a mean; 0: too few to take any together
  double start = 0.0, dt = 0.0;  ///< of the means [s]
  double quantum = 0.0;          ///< that means of whole counts come in [rad]
  double rounding = 0.0;         ///< error of slow motion that a mean keeps: 0 with dither [rad]
  double noise = 0.0;            ///< standard deviation of a mean [rad]
  std::vector<double> u, x1;     ///< [unit of u], [rad]

  MotorTrace trace(const std::string& file) const;
};

/// Noise of a sample fades with the root of the width. The width leaves kMeansPerHalfPeriod means in a half
/// period: a passage of the gap takes a tenth of one or more, and still shows begin and end.
/// @param facts  of this trace
BlockMeans block_means(const MotorTrace& trace, const SignalFacts& facts);

}  // namespace gapscope::internal::signals
