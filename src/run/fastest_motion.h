#pragma once

#include "config/configuration.h"

namespace gapscope::internal::run {

/// A row may hold so many time constants of the fastest motion, or the path through an impact in it cannot be
/// followed (and many times more take minutes).
inline constexpr double kMostTimesInARow = 1500.0;

/// What moves fastest in a drive: a body against its damper or, while the gap is closed, both against the
/// contact [1/s].
double fastest_rate(const SimulatedPlant& plant);

/// @throws ConfigError where that is out of all proportion to the rows of the simulation
void require_followable(const Configuration& simulated);

}  // namespace gapscope::internal::run
