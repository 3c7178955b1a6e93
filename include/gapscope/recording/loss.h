#pragma once

#include <cstddef>
#include <vector>

namespace gapscope {

/// A step that has room for more rows than the two at its ends.
struct Loss {
  std::size_t row = 0;   ///< before it
  std::size_t lost = 0;  ///< rows
};

/// The input before a loss as the mean of what stood there, the lost ones drawn as a line to the next row.
/// @param u  of rows of which the loss counts; the row after it is among them
template <class T>
void bridge(const Loss& loss, std::vector<T>& u) {
  const double rows = static_cast<double>(loss.lost) + 1.0;
  u[loss.row] += (u[loss.row + 1] - u[loss.row]) * ((rows - 1.0) / (2.0 * rows));
}

}  // namespace gapscope
