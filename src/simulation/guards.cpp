#include "simulation/guards.h"

#include <cmath>

namespace gapscope::internal::simulation {
namespace {

/// p(s)/s^zeros, which is positive at s = 0 unless the guard's event is due at once.
struct DeflatedGuard {
  struct Point {
    double value, slope;
  };

  const double* p;
  int degree;

  Point at(double s) const {
    Point q{p[degree], 0.0};
    for (int n = degree - 1; n >= 0; --n) {
      q.slope = q.slope * s + q.value;
      q.value = q.value * s + p[n];
    }
    return q;
  }

  /// A bound from below: p₀ less all that the falling terms can take away over (0, h]. What is zero
  /// throughout (a body at rest that nothing pushes) does not fall.
  bool may_fall(double h) const {
    double fall = 0.0, power = h;
    for (int n = 1; n <= degree; ++n, power *= h)
      if (p[n] < 0.0) fall -= p[n] * power;
    return p[0] < 0.0 || (fall > 0.0 && fall >= p[0]);
  }
};

/// Root in (low, high] by bisection and Newton: value(low) > 0 ≥ value(high).
double bracketed_root(const DeflatedGuard& g, double low, double high) {
  double s = high;
  for (int i = 0; i < 100 && high - low > 1e-16 * high; ++i) {
    const DeflatedGuard::Point q = g.at(s);
    if (q.value == 0.0) return s;
    (q.value > 0.0 ? low : high) = s;
    const double newton = q.slope != 0.0 ? s - q.value / q.slope : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == s) break;
    s = next;
  }
  return s;
}

/// Place of the minimum between a falling and a rising end.
double bracketed_minimum(const DeflatedGuard& g, double low, double high) {
  for (int i = 0; i < 48; ++i) {
    const double middle = 0.5 * (low + high);
    (g.at(middle).slope < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// First root in (0, h]; a negative number if there is none.
double first_root(const DeflatedGuard& g, double h) {
  constexpr int kPieces = 4;
  if (!g.may_fall(h)) return -1.0;
  double left = g.p[0] > 0.0 ? 0.0 : h / 64.0;
  DeflatedGuard::Point at_left = g.at(left);
  if (at_left.value <= 0.0) return 0.0;
  for (int piece = 1; piece <= kPieces; ++piece) {
    const double right = h * piece / kPieces;
    const DeflatedGuard::Point at_right = g.at(right);
    if (at_right.value <= 0.0) return bracketed_root(g, left, right);
    if (at_left.slope < 0.0 && at_right.slope > 0.0) {
      const double lowest = bracketed_minimum(g, left, right);
      if (g.at(lowest).value <= 0.0) return bracketed_root(g, left, lowest);
    }
    left = right, at_left = at_right;
  }
  return -1.0;
}

}  // namespace

Guard& GuardSet::add(GuardEvent event, int side, int zeros) {
  Guard& guard = guards[static_cast<std::size_t>(count++)];
  guard.event = event;
  guard.side = side;
  guard.zeros = zeros;
  return guard;
}

FirstEvent first_event(const GuardSet& set, double h) {
  FirstEvent first{-1, h};
  for (int i = 0; i < set.count; ++i) {
    const Guard& guard = set.guards[static_cast<std::size_t>(i)];
    const double root = first_root({guard.p + guard.zeros, guard.order - guard.zeros}, first.time);
    if (root >= 0.0 && (first.guard < 0 || root < first.time)) first = {i, root};
  }
  return first;
}

}  // namespace gapscope::internal::simulation
