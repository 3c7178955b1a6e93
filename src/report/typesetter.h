#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/freetype.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "report/geometry.h"
#include "report/palette.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {

cv::Scalar bgr(Colour c);  ///< as the library below orders it

/// What a line of text needs beside its baseline [px].
struct TextMetrics {
  double width = 0.0;
  double ascent = 0.0;   ///< above the baseline
  double descent = 0.0;  ///< below
  double height() const { return ascent + descent; }
};

/// Where one run stands, relative to the left end of the baseline [px, y downwards].
struct PlacedRun {
  TextRun run;
  double x = 0.0, y = 0.0;
  double size = 0.0;   ///< em [px]
  double width = 0.0;  ///< advance
};

/// The folder that holds DejaVuSans.ttf: $GAPSCOPE_FONTS, else the usual places of the distributions.
/// @throws std::runtime_error that says what to install or set where there is none.
std::string font_folder();

/// Sets lines of marked-up text in DejaVu Sans.
class Typesetter {
 public:
  Typesetter();

  /// @param size em [px]
  std::vector<PlacedRun> place(const std::string& markup, double size, bool bold = false) const;
  TextMetrics measure(const std::string& markup, double size, bool bold = false) const;

  /// The text in lines no wider than `width`; never broken within a formula.
  std::vector<std::string> wrapped(const std::string& text, double width, double size,
                                   bool bold = false) const;

  /// The circumflex over an estimate, from the left end of the baseline [px, y downwards].
  Polyline hat_of(const PlacedRun& placed, bool bold) const;
  /// Its stroke [px].
  static double hat_width(const PlacedRun& placed, bool bold) { return (bold ? 0.10 : 0.065) * placed.size; }

  /// Draws with the left end of the baseline at `at` (pixels of `image`, 8-bit BGR).
  void draw(cv::Mat& image, cv::Point2d at, const std::string& markup, double size, Colour colour,
            bool bold = false) const;

 private:
  cv::freetype::FreeType2& face(bool italic, bool bold) const;
  double advance(const TextRun& run, double size, bool bold) const;
  int ink_width(const std::string& text, bool italic, double size, bool bold) const;
  void draw_hat(cv::Mat& image, cv::Point2d at, const PlacedRun& placed, Colour colour, bool bold) const;

  mutable cv::Ptr<cv::freetype::FreeType2> upright_, italic_, bold_, bold_italic_;
  /// What was measured: most widths are asked for often.
  mutable std::map<std::tuple<std::string, bool, bool, int>, int> ink_widths_;
};

}  // namespace gapscope::internal::report
