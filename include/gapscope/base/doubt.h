#pragma once

#include <string>

namespace gapscope {

/// What holds against every number that is estimated from a recording, whichever estimator tells it: none of
/// them can be trusted well.
struct Doubt {
  std::string code;    ///< "fresh_samples", a rule of check; "input_timing", "not_random" of a residual
  std::string found;   ///< "x1 changes in every 2nd row only: read at some 500 Hz and held"
  std::string advice;  ///< what to do about it

  bool operator==(const Doubt&) const = default;
};

}  // namespace gapscope
