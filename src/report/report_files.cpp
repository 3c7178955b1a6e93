#include "report/report_files.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "report/draw_figure.h"

namespace gapscope::internal {
namespace {

namespace fs = std::filesystem;

/// Writes beside the target and renames, so that no half file is ever seen.
void write_file(const fs::path& path, const char* data, std::size_t size) {
  const fs::path partial = path.string() + ".partial";
  {
    std::ofstream out(partial, std::ios::binary);
    out.write(data, static_cast<std::streamsize>(size));
    if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
  }
  std::error_code error;
  fs::rename(partial, path, error);
  if (error) throw std::runtime_error(path.string() + ": cannot be written: " + error.message());
}

void write_png(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> png;
  cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 6});
  write_file(path, reinterpret_cast<const char*>(png.data()), png.size());
}

}  // namespace

void write_report_files(const std::string& folder, const std::vector<FigureData>& figures,
                        const std::string& text) {
  for (const FigureData& figure : figures) {
    const fs::path path = fs::path(folder) / figure.file;
    if (figure.missing.empty())
      write_png(path, draw(figure));
    else
      fs::remove(path);  // of an earlier result
  }
  write_file(fs::path(folder) / "report.md", text.data(), text.size());
}

}  // namespace gapscope::internal
