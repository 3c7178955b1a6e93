#pragma once

#include <cstddef>
#include <span>

namespace gapscope::internal::inspection {

/// Samples from one to before another.
struct OffStretch {
  std::size_t from = 0, to = 0;
  std::size_t length() const { return to - from; }
};

/// The one long stretch in which u is zero while x1 goes on moving, as where the drive was switched off;
/// dwells of a command come more than once. Empty: there is none.
/// @param quantum  of x1 [rad]
OffStretch switched_off(std::span<const double> u, std::span<const double> x1, double quantum);

}  // namespace gapscope::internal::inspection
