#include "report/typesetter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

namespace gapscope::internal::report {
namespace {

using Level = TextRun::Level;
constexpr double kScriptSize = 0.70;     // of the em
constexpr double kSubscriptDrop = 0.20;  // of the em, below the baseline
constexpr double kSuperscriptRise = 0.36;

cv::Ptr<cv::freetype::FreeType2> load(const std::string& folder, const char* name) {
  const std::string path = folder + "/" + name;
  if (!std::filesystem::exists(path))
    throw std::runtime_error(path + ": font is missing (Debian: fonts-dejavu-core and fonts-dejavu-extra)");
  auto face = cv::freetype::createFreeType2();
  try {
    face->loadFontData(path, 0);
  } catch (const cv::Exception&) {
    throw std::bad_alloc();  // it tells no reason; Debian's fonts are sound, so memory is what lacks
  }
  return face;
}

int pixels(double size) { return std::max(1, static_cast<int>(std::lround(size))); }

}  // namespace

cv::Scalar bgr(Colour c) { return {double(c.blue), double(c.green), double(c.red)}; }

std::string font_folder() {
  std::vector<std::string> folders;
  if (const char* own = std::getenv("GAPSCOPE_FONTS")) {
    folders = {own};
  } else {
    folders = {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
               "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF", "/usr/local/share/fonts"};
  }
  for (const std::string& folder : folders)
    if (std::filesystem::exists(folder + "/DejaVuSans.ttf")) return folder;
  throw std::runtime_error("no DejaVuSans.ttf in " + folders[0] +
                           ": install the DejaVu fonts (Debian: fonts-dejavu-core and fonts-dejavu-extra) or "
                           "set GAPSCOPE_FONTS to the folder that holds them");
}

Typesetter::Typesetter() {
  const std::string folder = font_folder();
  upright_ = load(folder, "DejaVuSans.ttf");
  italic_ = load(folder, "DejaVuSans-Oblique.ttf");
  bold_ = load(folder, "DejaVuSans-Bold.ttf");
  bold_italic_ = load(folder, "DejaVuSans-BoldOblique.ttf");
}

cv::freetype::FreeType2& Typesetter::face(bool italic, bool bold) const {
  if (bold) return italic ? *bold_italic_ : *bold_;
  return italic ? *italic_ : *upright_;
}

double Typesetter::advance(const TextRun& run, double size, bool bold) const {
  // The library measures ink; between two bars it is the advance, blanks at the ends included.
  return ink_width("|" + run.text + "|", run.italic, size, bold) - ink_width("||", run.italic, size, bold);
}

int Typesetter::ink_width(const std::string& text, bool italic, double size, bool bold) const {
  const auto [place, is_new] = ink_widths_.try_emplace({text, italic, bold, pixels(size)});
  int baseline = 0;
  if (is_new) place->second = face(italic, bold).getTextSize(text, pixels(size), -1, &baseline).width;
  return place->second;
}

std::vector<PlacedRun> Typesetter::place(const std::string& markup, double size, bool bold) const {
  std::vector<PlacedRun> placed;
  double x = 0.0;
  for (const TextRun& run : parse_markup(markup)) {
    const bool script = run.level != Level::kBase;
    PlacedRun p{run, x, 0.0, script ? kScriptSize * size : size, 0.0};
    if (run.level == Level::kSubscript) p.y = kSubscriptDrop * size;
    if (run.level == Level::kSuperscript) p.y = -kSuperscriptRise * size;
    p.width = advance(run, p.size, bold);
    x += p.width;
    placed.push_back(p);
  }
  return placed;
}

TextMetrics Typesetter::measure(const std::string& markup, double size, bool bold) const {
  TextMetrics metrics{0.0, 0.77 * size, 0.24 * size};  // ascenders and descenders of the face
  for (const PlacedRun& p : place(markup, size, bold)) {
    metrics.width = p.x + p.width;
    metrics.ascent = std::max(metrics.ascent, -p.y + (p.run.hat ? 1.0 : 0.77) * p.size);
    metrics.descent = std::max(metrics.descent, p.y + 0.24 * p.size);
  }
  return metrics;
}

void Typesetter::draw(cv::Mat& image, cv::Point2d at, const std::string& markup, double size, Colour colour,
                      bool bold) const {
  for (const PlacedRun& p : place(markup, size, bold)) {
    const cv::Point origin(cvRound(at.x + p.x), cvRound(at.y + p.y));
    face(p.run.italic, bold)
        .putText(image, p.run.text, origin, pixels(p.size), bgr(colour), -1, cv::LINE_AA, true);
    if (p.run.hat) draw_hat(image, at, p, colour, bold);
  }
}

Polyline Typesetter::hat_of(const PlacedRun& p, bool bold) const {
  int baseline = 0;
  const double ink = face(p.run.italic, bold).getTextSize(p.run.text, pixels(p.size), -1, &baseline).height;
  const double slant = p.run.italic ? 0.19 * ink : 0.0;  // the face leans by 11 degrees
  const double centre = p.x + 0.5 * p.width + slant;
  const double foot = p.y - ink - 0.05 * p.size;
  return {{centre - 0.17 * p.size, foot}, {centre, foot - 0.13 * p.size}, {centre + 0.17 * p.size, foot}};
}

void Typesetter::draw_hat(cv::Mat& image, cv::Point2d at, const PlacedRun& p, Colour colour,
                          bool bold) const {
  constexpr int kShift = 4;  // sixteenths of a pixel
  std::vector<cv::Point> hat;
  for (const Point& corner : hat_of(p, bold))
    hat.emplace_back(cvRound((at.x + corner.x) * 16.0), cvRound((at.y + corner.y) * 16.0));
  cv::polylines(image, hat, false, bgr(colour), pixels(hat_width(p, bold)), cv::LINE_AA, kShift);
}

std::vector<std::string> Typesetter::wrapped(const std::string& text, double width, double size,
                                             bool bold) const {
  std::vector<std::string> lines;
  std::istringstream words(text);
  std::string word, part;
  while (words >> part) {
    word += (word.empty() ? "" : " ") + part;
    if (std::count(word.begin(), word.end(), '$') % 2 != 0) continue;
    const bool fits = !lines.empty() && measure(lines.back() + " " + word, size, bold).width <= width;
    if (fits)
      lines.back() += " " + word;
    else
      lines.push_back(word);
    word.clear();
  }
  return lines;
}

}  // namespace gapscope::internal::report
