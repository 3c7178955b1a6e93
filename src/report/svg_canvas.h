#pragma once

#include <string>
#include <vector>

#include "report/canvas.h"
#include "report/panel_plan.h"

namespace gapscope::internal::report {

/// A drawing as SVG 1.1 (W3C, 2011): text stays text, of the width that the typesetter gives it, whatever
/// font the reader has.
class SvgCanvas : public Canvas {
 public:
  /// @param prefix  of the names within the document: several stand in one page
  explicit SvgCanvas(const Typesetter& typesetter, std::string prefix = "")
      : typesetter_(typesetter), prefix_(std::move(prefix)) {}

  void fill(const Box& box, Colour colour) override;
  void line(const Polyline& points, const LineStyle& style) override;
  void line(const Polyline& points, const LineStyle& style, const Box& clip) override;
  void marker(Point at, Marker marker, Colour colour, double size) override;
  void text(Point at, const std::string& markup, const TextStyle& style) override;

  /// A frame in which a script may find values: what its axes are called, and what their ends stand for.
  void plot(const Box& frame, const AxisPlan& x, const AxisPlan& y);

  /// The drawing as an element of a page, which scales it.
  /// @param more  attributes beside it
  std::string element(double width, double height, const std::string& title, const std::string& more) const;

  /// @param width, height  of the paper [px]
  /// @param pixel  how wide one is printed [m]
  /// @param title, reading  for those who cannot see the drawing
  std::string document(double width, double height, double pixel, const std::string& title,
                       const std::string& reading) const;

 private:
  void run(Point origin, const PlacedRun& placed, const TextStyle& style);
  /// @param more  attributes beside shape and stroke
  void path(const Polyline& points, const LineStyle& style, const std::string& more);
  std::string clip_name(const Box& clip);

  std::string clips() const;

  const Typesetter& typesetter_;
  std::string prefix_;
  std::string body_;
  std::vector<Box> clips_;
};

}  // namespace gapscope::internal::report
