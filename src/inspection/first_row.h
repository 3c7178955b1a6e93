#pragma once

#include <optional>

#include "gapscope/recording/recording.h"

namespace gapscope {

/// Where the first row of a recording has the input on while the drive still stands, and it moves soon after:
/// how long it stands [s]. What was sent before is not in the file then, so that a delay is told wrongly.
std::optional<double> begins_under_input(const MotorTrace& recording);

}  // namespace gapscope
