#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gapscope::internal::signals {

/// A way back that is a reversal, as a share of the travel; less is noise or a ripple [-]. With half and with
/// double of it 17 and 16 of 21 real recordings count the same reversals as with this one.
inline constexpr double kReversal = 0.05;

/// Where a drive turned round for good.
struct StrokeTurn {
  std::size_t sample = 0;  ///< the farthest position, the first of equal ones
  int direction = 0;       ///< of x behind it
};

/// @param x positions, at least one [rad]
std::vector<StrokeTurn> turns(std::span<const double> x);

/// Ways from one reversal to the next, the first and the last, which the recording cuts off, included; none
/// of what stands.
/// @param x positions, at least one [rad]
std::vector<double> strokes(std::span<const double> x);

}  // namespace gapscope::internal::signals
