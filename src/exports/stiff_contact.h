#pragma once

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "gapscope/plant/drive.h"

namespace gapscope::internal::exports {

struct StiffContact {
  double stiffness = 0.0, damping = 0.0;
};

/// A spring and damper in place of a rigid contact: as fast as an engine of 0.1 ms follows well, with the
/// damping that keeps the share e of a speed, ζ = −ln e/√(π² + ln² e).
/// @param mobility  1/m1 + 1/m2 [1/(kg m²)]
inline StiffContact stiff_contact(const DriveStructure& structure, double mobility) {
  constexpr double kFastest = 0.2 / 1e-4;  // rad/s
  const double log = std::log(std::max(structure.restitution, 1e-3));
  const double ratio = -log / std::hypot(kPi, log);
  return {kFastest * kFastest / mobility, 2.0 * ratio * kFastest / mobility};
}

}  // namespace gapscope::internal::exports
