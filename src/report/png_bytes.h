#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace gapscope::internal::report {

/// The bytes of a PNG (ISO/IEC 15948): a fifth more of them than the tightest, in a quarter of the time.
/// @param image  8-bit BGR
/// @param per_metre  pixels of the paper [1/m], as its chunk pHYs tells a reader
/// @param tight  as few as there may be, in 16 levels of each colour, in fewer where these make more than 256
/// colours
/// @throws std::runtime_error naming the figure
std::string png_bytes(const std::string& name, const cv::Mat& image, double per_metre, bool tight = false);

}  // namespace gapscope::internal::report
