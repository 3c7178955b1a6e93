#pragma once

#include <algorithm>

namespace gapscope::internal::sliding_mode {

constexpr double kInformativeShare = 0.1;  ///< of the travel, that a `none` may leave open
constexpr double kInformativeFloor = 5.0;  ///< times what encoder and noise alone would allow

/// Whether a denial says something: that nothing above `visible` is there.  @param finest  what encoder and
/// noise alone would have shown in this motion at this rate; all three [rad]
inline bool is_informative(double visible, double travel, double finest) {
  return visible <= std::min(kInformativeShare * travel, kInformativeFloor * finest);
}

}  // namespace gapscope::internal::sliding_mode
