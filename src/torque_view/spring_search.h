#pragma once

#include "torque_view/search.h"

namespace gapscope::internal::torque_view {

/// The spring at which a load gains most, beside what the model has: the better of a load without friction
/// and of one with its share of it, each from a grid of frequencies by least squares in all four numbers.
BestShape best_spring(Rows& rows, Projection& projection, const Law& law, const std::vector<double>& grid);
/// The same from a spring nearby.
BestShape refined_spring(Rows& rows, Projection& projection, const Law& law, const Scales& scales,
                         const Shape& from);

}  // namespace gapscope::internal::torque_view
