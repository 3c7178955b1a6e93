#pragma once

#include <cmath>

#include "fuzz/attempt.h"
#include "gapscope/recording/recording_file.h"

namespace gapscope::testing {

/// What every reader of a recording owes to those who use it.
inline void require_sound(const Recording& r) {
  require(r.size() >= kFewestSamples && r.u.size() == r.size() && (r.x2.empty() || r.x2.size() == r.size()),
          "columns of other lengths");
  require(r.dt > 0.0 && std::isfinite(r.dt) && std::isfinite(r.start), "no clock");
}

}  // namespace gapscope::testing
