#include "report/report_files.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <new>
#include <numeric>
#include <opencv2/core.hpp>
#include <ostream>

#include "base/parallel.h"
#include "gapscope/base/whole_file.h"
#include "report/draw_figure.h"
#include "report/panel_plan.h"
#include "report/plain_markdown.h"
#include "report/png_bytes.h"

namespace gapscope::internal::report {
namespace {

namespace fs = std::filesystem;

/// Of the image [1/m].
double pixels_per_metre(const FigureData& figure) { return figure.scale * figure.column / kColumnWidth; }

/// Without its title, and laid out narrower for the same width on paper: its smallest letters are 8 pt.
FigureData for_paper(FigureData figure) {
  constexpr double kPoint = 0.0254 / 72.0;  // [m]
  constexpr double kSmallest = kTickSize / kColumnPixels * kColumnWidth / kPoint;
  constexpr double kNarrower = kSmallest / 8.0;
  figure.title.clear();
  figure.lines.clear();  // what a caption says
  figure.width *= kNarrower;
  figure.column *= kNarrower;
  figure.scale /= kNarrower;
  return figure;
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  write_whole_file(path.string(), [&](std::ostream& out) { out << bytes; });
}

/// Nothing to put: of an earlier result.
void put_or_remove(const fs::path& path, const std::string& bytes) {
  if (bytes.empty())
    fs::remove(path);
  else
    write_bytes(path, bytes);
}

/// So no core is left with the largest figure at the end, and none needs more paper than the one before it.
std::vector<std::size_t> largest_first(const std::vector<FigureData>& figures) {
  std::vector<double> area;
  for (const FigureData& f : figures) {
    const auto add = [](double height, const Panel& panel) { return height + panel.height; };
    area.push_back(f.scale * f.scale * f.width / f.columns *
                   std::accumulate(f.panels.begin(), f.panels.end(), 0.0, add));
  }
  std::vector<std::size_t> order(figures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  return order;
}

}  // namespace

/// The library below has its own words for a machine that is too small.
std::string picture_bytes(const FigureData& figure, bool tight) {
  try {
    return png_bytes(figure.file, draw(figure), pixels_per_metre(figure), tight);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
    throw;
  }
}

std::string small_picture(FigureData figure) {
  constexpr double kHalf = 0.5;
  figure.scale *= kHalf;
  return picture_bytes(figure, true);
}

void write_report_files(const std::string& folder, const std::vector<FigureData>& figures,
                        const std::string& text, const FigureFormats& formats, const PageHead& head) {
  std::vector<Picture> pictures(figures.size());
  std::vector<std::string> images(figures.size()), drawings(figures.size());
  const std::vector<std::size_t> order = largest_first(figures);
  std::atomic<std::size_t> next{0};
  parallel_for(figures.size(), 0, [&](std::size_t) {
    const std::size_t i = order[next++];
    if (!figures[i].missing.empty()) return;
    const FigureData figure = formats.title ? figures[i] : for_paper(figures[i]);
    images[i] = formats.small ? small_picture(figure) : picture_bytes(figure);
    pictures[i] = {figures[i].file, draw_for_page(figures[i])};
    if (formats.svg) drawings[i] = draw_as_svg(figure);
  });
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const fs::path path = fs::path(folder) / figures[i].file;
    put_or_remove(path, images[i]);
    put_or_remove(fs::path(path).replace_extension(".svg"), drawings[i]);
  }
  write_bytes(fs::path(folder) / "report.md", plain_markdown(text));
  write_bytes(fs::path(folder) / "report.html", html_page(head, text, pictures));
}

}  // namespace gapscope::internal::report
