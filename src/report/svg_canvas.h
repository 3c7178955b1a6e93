#pragma once

#include <string>
#include <vector>

#include "report/canvas.h"

namespace gapscope::internal::report {

/// A drawing as SVG 1.1 (W3C, 2011): text stays text, of the width that the typesetter gives it, whatever
/// font the reader has.
class SvgCanvas : public Canvas {
 public:
  explicit SvgCanvas(const Typesetter& typesetter) : typesetter_(typesetter) {}

  void fill(const Box& box, Colour colour) override;
  void line(const Polyline& points, const LineStyle& style) override;
  void line(const Polyline& points, const LineStyle& style, const Box& clip) override;
  void marker(Point at, Marker marker, Colour colour, double size) override;
  void text(Point at, const std::string& markup, const TextStyle& style) override;

  /// @param width, height  of the paper [px]; kColumnPixels of them are kColumnWidth wide
  /// @param title, reading  for those who cannot see the drawing
  std::string document(double width, double height, const std::string& title,
                       const std::string& reading) const;

 private:
  void run(Point origin, const PlacedRun& placed, const TextStyle& style);
  /// @param more  attributes beside shape and stroke
  void path(const Polyline& points, const LineStyle& style, const std::string& more);
  std::string clip_name(const Box& clip);

  const Typesetter& typesetter_;
  std::string body_;
  std::vector<Box> clips_;
};

}  // namespace gapscope::internal::report
