#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "report/palette.h"

/// A figure as data, in SI units: everything is computed before anything is drawn. Texts are markup
/// (rich_text.h).
namespace gapscope::internal::report {

enum class Marker { kNone, kDisc, kCircle, kTriangleUp, kTriangleDown, kCross };

struct Series {
  std::string label{};  ///< in the legend; empty: not there
  LineStyle style{};
  std::vector<double> x{}, y{};  ///< NaN interrupts the line
  bool joined = true;            ///< a line through the points
  Marker marker = Marker::kNone;
  std::vector<Interval> x_intervals{};  ///< of each point, along x; empty: none
  std::vector<Interval> y_intervals{};
  bool stems = false;  ///< x_intervals are lines from zero to a dot, without the caps of an interval
};

/// A line across the frame.
struct Mark {
  double at = 0.0;
  LineStyle style{};
  std::string label{};  ///< vertical marks: written above the frame; horizontal ones: in the legend
};

/// A shaded part of the frame.
struct Band {
  Interval range{};
  Colour colour{};
  std::string label{};  ///< in the legend
};

/// A dimension as in a drawing, at the right of the frame.
struct Dimension {
  Interval range{};
  std::string label{};
};

/// A named place on an axis.
struct Place {
  double at = 0.0;
  std::string label{};
};

/// A field of a map. With a text in its middle it stands apart from its neighbours, without one it touches
/// them.
struct Tile {
  Interval x{}, y{};
  Colour colour{};
  std::string text{};
  Colour ink = kInk;
  std::string note{};  ///< smaller, under the text
};

struct Axis {
  std::string name{};  ///< "displacement $x_1$"
  std::string unit{};  ///< SI; the drawing chooses the prefix
  Interval range{};    ///< NaN: from the data
  std::vector<std::string>
      categories{};                    ///< names of the places 0, 1, 2, ... (from above) instead of numbers
  std::vector<std::string> remarks{};  ///< at the right of each category
  std::vector<Place> places{};         ///< instead of round numbers
  std::string unit_note{};             ///< what the unit rests on, behind it: "$K_m$ guessed"
};

struct Panel {
  std::string title{};
  Axis x{}, y{};
  double height = 480.0;  ///< of the frame [px]
  bool x_labels = true;   ///< false: the panel below has the same x axis
  std::vector<Band> x_bands{}, y_bands{};
  std::vector<Mark> x_marks{}, y_marks{};  ///< vertical lines at x, horizontal lines at y
  std::vector<Dimension> dimensions{};     ///< along y
  std::vector<Tile> tiles{};
  std::vector<Series> series{};
};

/// Of a sheet of many panels, which is looked at on a screen and not printed in a column.
inline constexpr double kSheetScale = 0.75;

/// A column of a journal, which a figure of 1600 px fills [m].
inline constexpr double kColumnWidth = 0.085;
inline constexpr double kColumnPixels = 1600.0;

struct FigureData {
  std::string file{};  ///< name of the PNG
  std::string title{};
  std::string reading{};             ///< one line: what this figure shows here
  std::string missing{};             ///< why there is no such figure; empty: there is one
  bool expected = true;              ///< false: nobody would look for it here, so its absence needs no word
  std::vector<std::string> lines{};  ///< text under the title, wrapped
  double width = 1600.0;             ///< [px]
  double scale = 1.0;                ///< of the image: a sheet that is only looked at needs fewer pixels
  double column = kColumnPixels;     ///< that fill a column of a journal [px]
  int columns = 1;
  std::vector<Panel> panels{};  ///< row by row
};

/// A figure that this result cannot have.
/// @param expected  false: nobody would look for it here
inline FigureData missing_figure(FigureData figure, std::string why, bool expected = true) {
  figure.missing = std::move(why);
  figure.expected = expected;
  return figure;
}

}  // namespace gapscope::internal::report
