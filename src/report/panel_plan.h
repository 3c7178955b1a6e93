#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "report/geometry.h"
#include "report/ticks.h"
#include "report/typesetter.h"

namespace gapscope::internal::report {

// Sizes of a figure [px at a width of 1600].
inline constexpr double kTitleSize = 46.0;
inline constexpr double kTextSize = 40.0;
inline constexpr double kTickSize = 38.0;
inline constexpr double kSpace = 14.0;  ///< between neighbouring pieces
/// From the frame to the numbers below it: clear of those beside it.
inline constexpr double kToTicks = 24.0;
inline constexpr double kTitleGap = 4.0;  ///< below a panel's title
inline constexpr double kRim = 26.0;      ///< around everything
inline constexpr double kSample = 70.0;   ///< line sample in a legend

/// An axis ready to draw: its range, its round places and what is written on it.
struct AxisPlan {
  Interval range;
  Ticks ticks;  ///< in units of `factor`
  double factor = 1.0;
  std::string label;
  std::vector<std::string> lines;  ///< the label of an upright axis, in two where it is longer than the axis
  std::vector<std::string> names;  ///< of the ticks, where they are named places

  double fraction(double value) const { return (value - range.low) / (range.high - range.low); }
  std::string tick_text(std::size_t i) const {
    return names.empty() ? tick_label(ticks.values[i], ticks.decimals) : names[i];
  }
};

/// @param length of the axis [px]   @param upright true for the y axis
AxisPlan plan_axis(const Axis& axis, Interval data, double length, bool upright,
                   const Typesetter& typesetter);

/// Room that the label of an upright axis takes beside it.
double label_thickness(const AxisPlan& plan, const Typesetter& typesetter);

/// Range of all that a panel shows along x or y.
Interval x_range(const Panel& panel);
Interval y_range(const Panel& panel);

struct LegendEntry {
  std::string label;
  LineStyle style;
  Marker marker = Marker::kNone;
  bool joined = true;
  bool shade = false;  ///< a band
};
std::vector<LegendEntry> legend_entries(const Panel& panel);

/// A legend laid out in rows: above the frame, where it hides neither data nor grid.
struct Legend {
  double height = 0.0;
  std::vector<Point> places;  ///< left end of each entry's baseline, relative to the legend's upper left
};
Legend flowing_legend(const std::vector<LegendEntry>& entries, double width, const Typesetter& typesetter);

/// Room that a panel needs at the left and right of its frame.
struct Margins {
  double left = 0.0, right = 0.0;
};
Margins side_margins(const Panel& panel, const Typesetter& typesetter);

/// A panel with everything in its place, relative to the upper left corner of its frame.
struct PanelPlan {
  AxisPlan x, y;
  double width = 0.0, height = 0.0;  ///< of the frame
  double above = 0.0, below = 0.0;   ///< room for what stands outside of it
  std::vector<std::string> title;    ///< in lines that are no wider than its room
  std::vector<LegendEntry> entries;
  Legend legend;

  Point place(double px, double py) const {
    return {x.fraction(px) * width, (1.0 - y.fraction(py)) * height};
  }
};
/// @param width  of the frame [px]   @param room  for title and legend above it, from its left edge [px]
PanelPlan plan_panel(const Panel& panel, const std::string& title, double width, double room,
                     const Typesetter& typesetter);

/// The pieces of a series between its undefined points, decimated for a frame of this plan.
std::vector<Polyline> polylines_of(const Series& series, const PanelPlan& plan);

}  // namespace gapscope::internal::report
