#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "report/figure_data.h"
#include "report/geometry.h"
#include "report/palette.h"
#include "report/typesetter.h"

namespace gapscope::internal::report {

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  double size = 40.0;  ///< em [px]
  Align align = Align::kLeft;
  Colour colour = kInk;
  bool bold = false;
  bool upwards = false;  ///< turned by 90 degrees, read from below
};

/// What was written where: a test checks that no two texts meet and none is cut off.
struct DrawnText {
  Box box;
  std::string markup;
};

/// White paper, in pixels of the finished image at scale 1. Everything is drawn at twice the size and
/// averaged down, so that thin lines and small letters come out smooth.
class Canvas {
 public:
  /// @param scale  of the image: everything else is told as if it were 1
  Canvas(double width, double height, const Typesetter& typesetter, double scale = 1.0);

  void fill(const Box& box, Colour colour);
  void line(const Polyline& points, const LineStyle& style);
  /// The part of the line within the box.
  void line(const Polyline& points, const LineStyle& style, const Box& clip);
  void marker(Point at, Marker marker, Colour colour, double size);
  /// @param at the left end, middle or right end of the baseline, as the style aligns it
  void text(Point at, const std::string& markup, const TextStyle& style);

  cv::Mat image() const;
  const std::vector<DrawnText>& texts() const { return texts_; }

 private:
  double fine_;  ///< of the paper, in its pixels
  cv::Mat paper_;
  const Typesetter& typesetter_;
  std::vector<DrawnText> texts_;
};

}  // namespace gapscope::internal::report
