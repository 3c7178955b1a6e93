#pragma once

#include <algorithm>
#include <vector>

namespace gapscope::internal::report {

/// A point of the image [px], y downwards.
struct Point {
  double x = 0.0, y = 0.0;
};

/// A rectangle of the image [px].
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  Point centre() const { return {x + width / 2, y + height / 2}; }
  Box scaled(double by) const { return {x * by, y * by, width * by, height * by}; }
  Box grown(double margin) const { return {x - margin, y - margin, width + 2 * margin, height + 2 * margin}; }
  bool holds(const Box& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
};

inline bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

using Polyline = std::vector<Point>;

/// Whether a line from a to b has a point within the box: what it has between the sides that it enters and
/// leaves by.
inline bool meets(Point a, Point b, const Box& box) {
  double enters = 0.0, leaves = 1.0;
  const auto cut = [&](double from, double to, double low, double high) {
    const double way = to - from;
    if (way == 0.0) return from >= low && from <= high;
    const double one = (low - from) / way, other = (high - from) / way;
    enters = std::max(enters, std::min(one, other)), leaves = std::min(leaves, std::max(one, other));
    return enters <= leaves;
  };
  return cut(a.x, b.x, box.x, box.right()) && cut(a.y, b.y, box.y, box.bottom());
}

inline bool meets(const Polyline& line, const Box& box) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (meets(line[i - 1], line[i], box)) return true;
  return false;
}

}  // namespace gapscope::internal::report
