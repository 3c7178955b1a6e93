#pragma once

#include <string>
#include <vector>

#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// What a drive that is driven alike leaves of an error that a model could explain: its rms difference from
/// one period to the next, over √2 (the model's own error, however large, is the same in both).
struct Repeatability {
  double innovation = kNaN, free = kNaN;  ///< [rad]; NaN: no recording repeats its input
  bool stationary = true;                 ///< periods two apart differ no more than neighbours do
  std::string read_from;                  ///< "3.9 periods of 6.24 s in run.csv"
};

/// @param playbacks of one model; restarts are those of held_out
Repeatability repeatability_of(const std::vector<Playback>& playbacks, const HeldOut& held_out);

}  // namespace gapscope::internal::diagnosis
