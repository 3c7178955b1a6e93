#include "gapscope/report/report.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "gapscope/results/run_result.h"
#include "report/draw_figure.h"
#include "report/figures.h"
#include "report/markdown.h"

namespace gapscope {
namespace fs = std::filesystem;
namespace {

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

void write_report(const std::string& folder) {
  const RunResult run = read_run_result(folder);
  const internal::ReportView view(run);
  const std::vector<internal::FigureData> figures = internal::all_figures(view);
  for (const internal::FigureData& figure : figures) {
    const fs::path path = fs::path(folder) / figure.file;
    if (figure.missing.empty())
      write_png(path, internal::draw(figure));
    else
      fs::remove(path);  // of an earlier result
  }
  const std::string text = internal::report_text(run, read_timing(folder), figures);
  write_file(fs::path(folder) / "report.md", text.data(), text.size());
}

}  // namespace gapscope
