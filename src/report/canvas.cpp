#include "report/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "report/paper.h"

namespace gapscope::internal::report {
namespace {

constexpr double kFine = 2.0;    // drawn at so many times the size of the image, averaged down
constexpr int kShift = 4;        // sixteenths of a fine pixel
constexpr double kUnseen = 4.0;  // a corner so far beside a straight line [sixteenths of a fine pixel]
constexpr std::size_t kMostUnseen = 32;  // in a row: work stays in proportion to the corners
constexpr double kFar = 1e5;             // beyond any paper; keeps sub-pixel coordinates within an int

cv::Point sub_pixel(Point p, double fine) {
  const auto fixed = [=](double v) { return cvRound(std::clamp(v, -kFar, kFar) * fine * (1 << kShift)); };
  return {fixed(p.x), fixed(p.y)};
}

int fine_width(double width, double fine) { return std::max(1, cvRound(width * fine)); }

cv::Rect fine_rect(const Box& box, const cv::Mat& paper, double fine) {
  const cv::Point corner(cvRound(box.x * fine), cvRound(box.y * fine));
  const cv::Point end(cvRound(box.right() * fine), cvRound(box.bottom() * fine));
  return cv::Rect(corner, end) & cv::Rect(0, 0, paper.cols, paper.rows);
}

/// Cuts a line into its dashes.
std::vector<Polyline> dashes_of(const Polyline& line, const std::vector<double>& pattern) {
  if (pattern.empty()) return {line};
  std::vector<Polyline> dashes{{line.front()}};
  std::size_t part = 0;  // even parts are drawn
  double left = pattern[0];
  for (std::size_t i = 1; i < line.size(); ++i) {
    Point at = line[i - 1];
    double length = std::hypot(line[i].x - at.x, line[i].y - at.y);
    while (length > left) {
      at = {at.x + (line[i].x - at.x) * left / length, at.y + (line[i].y - at.y) * left / length};
      length -= left;
      if (part % 2 == 0) dashes.back().push_back(at);
      part = (part + 1) % pattern.size();
      left = pattern[part];
      if (part % 2 == 0) dashes.push_back({at});
    }
    left -= length;
    if (part % 2 == 0) dashes.back().push_back(line[i]);
  }
  return dashes;
}

/// Of a point from the segment a-b, not from its line: a spike that returns within one column of pixels is
/// far.
double distance(cv::Point2d p, cv::Point2d a, cv::Point2d b) {
  const cv::Point2d along = b - a;
  const double length2 = along.dot(along);
  const double part = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return cv::norm(p - a - part * along);
}

/// Of dense samples most corners are: each costs as much as a long stroke.
std::vector<cv::Point> without_unseen_corners(const std::vector<cv::Point>& line) {
  std::vector<cv::Point> seen;
  std::size_t last = 0;  // of those that are seen
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto unseen = [&](const cv::Point& p) { return distance(p, line[last], line[i + 1]) <= kUnseen; };
    const auto first = line.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    const auto end = line.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (i > 0 && i + 1 < line.size() && i - last <= kMostUnseen && std::all_of(first, end, unseen)) continue;
    seen.push_back(line[i]);
    last = i;
  }
  return seen;
}

void stroke(cv::Mat& paper, const Polyline& points, const LineStyle& style, double fine) {
  if (points.empty()) return;
  for (const Polyline& dash : dashes_of(points, style.dashes)) {
    std::vector<cv::Point> fixed;
    for (const Point& p : dash) fixed.push_back(sub_pixel(p, fine));
    cv::polylines(paper, without_unseen_corners(fixed), false, bgr(style.colour),
                  fine_width(style.width, fine), cv::LINE_AA, kShift);
  }
}

void polygon(cv::Mat& paper, const Polyline& corners, Colour colour, double fine) {
  std::vector<cv::Point> fixed;
  for (const Point& p : corners) fixed.push_back(sub_pixel(p, fine));
  cv::fillPoly(paper, fixed, bgr(colour), cv::LINE_AA, kShift);
}

}  // namespace

Polyline triangle(Point at, Marker marker, double size) {
  const double r = size / 2, up = marker == Marker::kTriangleUp ? -r : r;
  return {{at.x - r, at.y - up * 0.75}, {at.x + r, at.y - up * 0.75}, {at.x, at.y + up}};
}

std::array<Polyline, 2> cross(Point at, double size) {
  const double arm = 0.4 * size;
  return {Polyline{{at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}},
          Polyline{{at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}}};
}

PixelCanvas::PixelCanvas(double width, double height, const Typesetter& typesetter, double scale)
    : fine_(kFine * scale), typesetter_(typesetter) {
  paper_ = sheet(static_cast<int>(kFine) * cvRound(height * scale),
                 static_cast<int>(kFine) * cvRound(width * scale));
  paper_.setTo(cv::Scalar::all(255));
}

void PixelCanvas::fill(const Box& box, Colour colour) {
  paper_(fine_rect(box, paper_, fine_)).setTo(bgr(colour));
}

void PixelCanvas::line(const Polyline& points, const LineStyle& style) {
  stroke(paper_, points, style, fine_);
}

void PixelCanvas::line(const Polyline& points, const LineStyle& style, const Box& clip) {
  const cv::Rect part = fine_rect(clip, paper_, fine_);
  if (part.empty()) return;
  Polyline moved;
  for (const Point& p : points) moved.push_back({p.x - part.x / fine_, p.y - part.y / fine_});
  cv::Mat inside = paper_(part);
  stroke(inside, moved, style, fine_);
}

void PixelCanvas::marker(Point at, Marker marker, Colour colour, double size) {
  const double r = size / 2;
  switch (marker) {
    case Marker::kNone:
      return;
    case Marker::kDisc:
    case Marker::kCircle:
      cv::circle(paper_, sub_pixel(at, fine_), cvRound(r * fine_ * (1 << kShift)), bgr(colour), cv::FILLED,
                 cv::LINE_AA, kShift);
      if (marker == Marker::kCircle)
        cv::circle(paper_, sub_pixel(at, fine_), cvRound((r - kRing) * fine_ * (1 << kShift)),
                   cv::Scalar::all(255), cv::FILLED, cv::LINE_AA, kShift);
      return;
    case Marker::kTriangleUp:
    case Marker::kTriangleDown:
      return polygon(paper_, triangle(at, marker, size), colour, fine_);
    case Marker::kCross:
      for (const Polyline& stroke_of_it : cross(at, size))
        stroke(paper_, stroke_of_it, {colour, kCrossWidth, {}}, fine_);
  }
}

void PixelCanvas::text(Point at, const std::string& markup, const TextStyle& style) {
  const TextMetrics fine = typesetter_.measure(markup, style.size * fine_, style.bold);
  const double width = fine.width / fine_, ascent = fine.ascent / fine_, descent = fine.descent / fine_;
  const double before = style.align == Align::kLeft ? 0.0 : style.align == Align::kCentre ? width / 2 : width;
  if (!style.upwards) {
    texts_.push_back({{at.x - before, at.y - ascent, width, ascent + descent}, markup});
    typesetter_.draw(paper_, {(at.x - before) * fine_, at.y * fine_}, markup, style.size * fine_,
                     style.colour, style.bold);
    return;
  }
  const Box box{at.x - ascent, at.y + before - width, ascent + descent, width};
  texts_.push_back({box, markup});
  constexpr int kStripRim = 8;  // for italics that lean out of their box [fine px]
  cv::Mat strip(cvCeil(fine.height()) + 2 * kStripRim, cvCeil(fine.width) + 2 * kStripRim, CV_8UC3,
                cv::Scalar::all(255));
  typesetter_.draw(strip, {kStripRim, fine.ascent + kStripRim}, markup, style.size * fine_, style.colour,
                   style.bold);
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place(cvRound(box.x * fine_) - kStripRim, cvRound(box.y * fine_) - kStripRim, strip.cols,
                       strip.rows);
  const cv::Rect seen = place & cv::Rect(0, 0, paper_.cols, paper_.rows);
  if (seen.empty()) return;
  cv::Mat under = paper_(seen);
  cv::min(under, strip(seen - place.tl()), under);
}

cv::Mat PixelCanvas::image() const {
  cv::Mat small = sheet(paper_.rows / static_cast<int>(kFine), paper_.cols / static_cast<int>(kFine));
  cv::resize(paper_, small, small.size(), 0.0, 0.0, cv::INTER_AREA);
  return small;
}

}  // namespace gapscope::internal::report
