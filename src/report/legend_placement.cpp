#include "report/legend_placement.h"

#include <cmath>

namespace gapscope::internal {

bool crosses(const Box& box, Point a, Point b) {
  // Liang and Barsky: the part of the segment within the box runs from t0 to t1.
  double t0 = 0.0, t1 = 1.0;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double p[] = {-dx, dx, -dy, dy};
  const double q[] = {a.x - box.x, box.right() - a.x, a.y - box.y, box.bottom() - a.y};
  for (int side = 0; side < 4; ++side) {
    if (p[side] == 0.0) {
      if (q[side] < 0.0) return false;
      continue;
    }
    const double t = q[side] / p[side];
    if (p[side] < 0.0)
      t0 = std::max(t0, t);
    else
      t1 = std::min(t1, t);
  }
  return t0 <= t1;
}

namespace {

bool hides_data(const Box& box, const std::vector<Polyline>& lines) {
  for (const Polyline& line : lines) {
    if (line.size() == 1 && crosses(box, line[0], line[0])) return true;
    for (std::size_t i = 1; i < line.size(); ++i)
      if (crosses(box, line[i - 1], line[i])) return true;
  }
  return false;
}

}  // namespace

std::optional<Box> empty_place(const Box& frame, double width, double height, double margin,
                               const std::vector<Polyline>& lines) {
  const double left = frame.x + margin, right = frame.right() - margin - width;
  const double top = frame.y + margin, bottom = frame.bottom() - margin - height;
  const double middle_x = frame.centre().x - width / 2, middle_y = frame.centre().y - height / 2;
  if (left > right || top > bottom) return std::nullopt;
  const Point corners[] = {{right, top},    {left, top},        {right, bottom},   {left, bottom},
                           {middle_x, top}, {middle_x, bottom}, {right, middle_y}, {left, middle_y}};
  for (const Point& corner : corners) {
    const Box box{corner.x, corner.y, width, height};
    if (!hides_data(box.grown(margin / 2), lines)) return box;
  }
  return std::nullopt;
}

}  // namespace gapscope::internal
