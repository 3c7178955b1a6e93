#pragma once

#include "gapscope/base/statistics.h"

namespace gapscope {

/// Half the width of a 95 % interval of a normal distribution, in standard deviations.
constexpr double kNormal95 = 1.96;

/// value ± kNormal95 · std; NaN bounds where the standard deviation is not known.
inline Interval normal_interval(double value, double std) {
  return {value - kNormal95 * std, value + kNormal95 * std};
}

}  // namespace gapscope
