#include "report/report_files.h"

#include <png.h>

#include <filesystem>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <ostream>
#include <stdexcept>

#include "gapscope/base/whole_file.h"
#include "report/draw_figure.h"

namespace gapscope::internal::report {
namespace {

namespace fs = std::filesystem;

/// A fifth more bytes than the tightest in a quarter of the time.
void write_png(const fs::path& path, const cv::Mat& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.cols);
  header.height = static_cast<png_uint_32>(image.rows);
  header.format = PNG_FORMAT_BGR;
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  const auto bytes = std::make_unique_for_overwrite<char[]>(size);
  if (png_image_write_to_memory(&header, bytes.get(), &size, 0, image.data,
                                static_cast<png_int_32>(image.step), nullptr) == 0)
    throw std::runtime_error(path.string() + ": " + header.message);
  write_whole_file(path.string(),
                   [&](std::ostream& out) { out.write(bytes.get(), static_cast<long>(size)); });
}

/// The library below has its own words for a machine that is too small.
void draw_file(const fs::path& path, const FigureData& figure) {
  try {
    write_png(path, draw(figure));
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
    throw;
  }
}

}  // namespace

void write_report_files(const std::string& folder, const std::vector<FigureData>& figures,
                        const std::string& text) {
  for (const FigureData& figure : figures) {
    const fs::path path = fs::path(folder) / figure.file;
    if (figure.missing.empty())
      draw_file(path, figure);
    else
      fs::remove(path);  // of an earlier result
  }
  write_whole_file(folder + "/report.md", [&](std::ostream& out) { out << text; });
}

}  // namespace gapscope::internal::report
