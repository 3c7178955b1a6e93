#pragma once

#include <string>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// A number with its name: a parameter of an effect or of the drive.
struct NamedValue {
  std::string key;
  std::string unit;
  double value = kNaN;
  Interval ci95 = {};  ///< where a fit tells it; else NaN
};

}  // namespace gapscope
