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

}  // namespace gapscope::internal::report
