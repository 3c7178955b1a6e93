#pragma once

#include <optional>
#include <vector>

#include "report/geometry.h"

namespace gapscope::internal {

/// A place within the frame, in a corner or at the middle of a side, where a legend of this size lies at
/// least `margin` away from all lines; none if it would hide data everywhere.
std::optional<Box> empty_place(const Box& frame, double width, double height, double margin,
                               const std::vector<Polyline>& lines);

}  // namespace gapscope::internal
