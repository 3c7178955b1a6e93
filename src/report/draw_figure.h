#pragma once

#include <opencv2/core.hpp>

#include "report/canvas.h"
#include "report/figure_data.h"
#include "report/panel_plan.h"

namespace gapscope::internal::report {

/// An image and what a test wants to know of it.
struct Drawing {
  cv::Mat image;                 ///< 8-bit BGR
  std::vector<DrawnText> texts;  ///< everything that was written
  std::vector<Box> frames;       ///< of the panels, in their order
  std::vector<PanelPlan> plans;
};
Drawing draw_with_notes(const FigureData& figure);

/// @throws std::runtime_error without fonts.
cv::Mat draw(const FigureData& figure);

/// The same figure as an SVG of that size on paper, its text as text.
std::string draw_as_svg(const FigureData& figure);

/// The same as an element of a page, with the frames in which a script finds values.
std::string draw_for_page(const FigureData& figure);

/// Draws one panel with the upper left corner of its frame at `corner`.
void draw_panel(Canvas& canvas, const Panel& panel, const PanelPlan& plan, Point corner, double left_margin,
                const Typesetter& typesetter);

}  // namespace gapscope::internal::report
