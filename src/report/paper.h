#pragma once

#include <opencv2/core.hpp>

namespace gapscope::internal::report {

/// An image of 8-bit BGR, not yet of any colour, on memory that images before it had: coming by tens of
/// megabytes, page by page, takes longer than drawing on them. What such an image leaves behind is kept for
/// the next one until the process ends.
/// @throws std::bad_alloc
cv::Mat sheet(int rows, int columns);

}  // namespace gapscope::internal::report
