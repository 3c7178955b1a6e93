#include "report/report_files.h"

#include <filesystem>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <ostream>
#include <string_view>

#include "gapscope/base/whole_file.h"
#include "report/draw_figure.h"

namespace gapscope::internal::report {
namespace {

namespace fs = std::filesystem;

void write_png(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> png;
  cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 6});
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
  write_whole_file(path.string(), [&](std::ostream& out) { out << bytes; });
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
