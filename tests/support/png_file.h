#pragma once

#include <png.h>

#include <opencv2/core.hpp>
#include <string>

namespace gapscope::testing {

/// The picture in a PNG file, in BGR; empty where there is none.
inline cv::Mat picture_of(const std::string& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, path.c_str()) == 0) return {};
  header.format = PNG_FORMAT_BGR;
  cv::Mat picture(static_cast<int>(header.height), static_cast<int>(header.width), CV_8UC3);
  return png_image_finish_read(&header, nullptr, picture.data, 0, nullptr) == 0 ? cv::Mat() : picture;
}

}  // namespace gapscope::testing
