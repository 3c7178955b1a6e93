#pragma once

#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::sliding_mode {

/// Where the torque changes sign: from there on a motor that rested at its load crosses the gap.
struct TorqueTurn {
  std::size_t quiet = 0;  ///< first sample of the stay at no torque that ends there
  std::size_t zero = 0;   ///< last sample before the torque rises
  std::size_t next = 0;   ///< … and before it changes sign again
  int direction = 0;      ///< of the torque that follows
};

std::vector<TorqueTurn> torque_turns(const MotorTrace& trace);

}  // namespace gapscope::internal::sliding_mode
