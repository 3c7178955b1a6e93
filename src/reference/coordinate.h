#pragma once

#include <algorithm>
#include <cmath>

#include "gapscope/plant/scalar.h"

namespace gapscope::internal::reference {

/// How a physical number p is presented to the solver as q.
///   positive numbers:  p = 2 s sinh q — logarithmic above the small scale s, linear below it, so that ratios
///                      of ten are small steps and zero can still be reached;
///   other numbers:     p = p0 + s q.
struct Coordinate {
  bool positive = true;
  double scale = 1.0;   ///< s
  double origin = 0.0;  ///< p0

  static Coordinate logarithmic(double typical) { return {true, 1e-3 * typical, 0.0}; }
  static Coordinate linear(double origin, double scale) { return {false, scale, origin}; }

  template <class T>
  T physical(const T& q) const {
    using std::sinh;
    if (positive) return 2.0 * scale * sinh(q);
    return origin + scale * q;
  }
  double solver(double p) const { return positive ? std::asinh(p / (2.0 * scale)) : (p - origin) / scale; }
  /// dp/dq
  double slope(double q) const { return positive ? 2.0 * scale * std::cosh(q) : scale; }
};

}  // namespace gapscope::internal::reference
