#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "report/figure_data.h"
#include "report/geometry.h"
#include "report/palette.h"
#include "report/typesetter.h"

namespace gapscope::internal::report {

enum class Align { kLeft, kCentre, kRight };

inline constexpr double kRing = 3.5;  ///< width of the rim of Marker::kCircle [px]

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

/// White paper, in pixels of the finished image at scale 1, y downwards.
class Canvas {
 public:
  virtual ~Canvas() = default;

  virtual void fill(const Box& box, Colour colour) = 0;
  virtual void line(const Polyline& points, const LineStyle& style) = 0;
  /// The part of the line within the box.
  virtual void line(const Polyline& points, const LineStyle& style, const Box& clip) = 0;
  virtual void marker(Point at, Marker marker, Colour colour, double size) = 0;
  /// @param at the left end, middle or right end of the baseline, as the style aligns it
  virtual void text(Point at, const std::string& markup, const TextStyle& style) = 0;
};

/// Everything is drawn at twice the size and averaged down, so that thin lines and small letters come out
/// smooth.
class PixelCanvas : public Canvas {
 public:
  /// @param scale  of the image: everything else is told as if it were 1
  PixelCanvas(double width, double height, const Typesetter& typesetter, double scale = 1.0);

  void fill(const Box& box, Colour colour) override;
  void line(const Polyline& points, const LineStyle& style) override;
  void line(const Polyline& points, const LineStyle& style, const Box& clip) override;
  void marker(Point at, Marker marker, Colour colour, double size) override;
  void text(Point at, const std::string& markup, const TextStyle& style) override;

  cv::Mat image() const;
  const std::vector<DrawnText>& texts() const { return texts_; }

 private:
  double fine_;  ///< of the paper, in its pixels
  cv::Mat paper_;
  const Typesetter& typesetter_;
  std::vector<DrawnText> texts_;
};

inline constexpr double kCrossWidth = 4.0;  ///< of the strokes of Marker::kCross [px]

// The shapes of markers, for every canvas.
Polyline triangle(Point at, Marker marker, double size);
std::array<Polyline, 2> cross(Point at, double size);

}  // namespace gapscope::internal::report
