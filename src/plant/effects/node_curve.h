#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gapscope/plant/scalar.h"

namespace gapscope::internal::plant {

/// Nodes at (k/N)², k = 0 ... N: closer where most laws of friction and of inputs bend.
template <int N>
struct Nodes {
  using Row = std::array<double, N + 1>;  ///< a number for the value at each node

  static constexpr double at(int k) { return static_cast<double>(k * k) / (N * N); }
  static constexpr double width(int piece) { return at(piece + 1) - at(piece); }

  /// What the value at each node adds to the second derivative at each node of the natural cubic spline,
  /// whose slope and curvature are continuous: M_0 = M_N = 0 and in between
  /// h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 (slope of chord k − slope of chord k − 1).
  static constexpr std::array<Row, N + 1> curvatures() {
    std::array<Row, N + 1> m{};
    Row upper{};  // of the eliminated system
    for (int k = 1; k < N; ++k) {
      const double before = width(k - 1), after = width(k),
                   pivot = 2.0 * (before + after) - before * upper[k - 1];
      upper[k] = after / pivot;
      Row chords{};
      chords[k - 1] = 6.0 / before, chords[k] = -6.0 / before - 6.0 / after, chords[k + 1] = 6.0 / after;
      for (int j = 0; j <= N; ++j) m[k][j] = (chords[j] - before * m[k - 1][j]) / pivot;
    }
    for (int k = N - 1; k > 0; --k)
      for (int j = 0; j <= N; ++j) m[k][j] -= upper[k] * m[k + 1][j];
    return m;
  }
};

/// The piece of a curve by nodes in which a place lies.
template <int N>
int piece_at(double s) {
  return s < 1.0 ? std::clamp(static_cast<int>(N * std::sqrt(std::max(s, 0.0))), 0, N - 1) : N;
}

/// How a curve goes on beyond its last node.
enum class Beyond {
  kLevel,    ///< a parabola takes its slope to zero within a quarter of the last piece; it is constant then
  kStraight  ///< with the slope that it has there
};

/// A natural cubic spline through the nodes over [0, 1], and what it is beyond.
template <int N, Beyond beyond>
class NodeWeights {
 public:
  using Row = typename Nodes<N>::Row;
  static constexpr double kLevelledOver = 0.25 * Nodes<N>::width(N - 1);

  explicit NodeWeights(double s) {
    const int piece = piece_at<N>(s);
    if (piece < N) {
      cubic(piece, s);
    } else {
      cubic(N - 1, 1.0);
      beyond == Beyond::kLevel ? level_off(s - 1.0) : go_on(s - 1.0);
    }
  }

  /// What the value at a node adds to that of the curve, and to its slope.
  double value(int k) const { return value_[static_cast<std::size_t>(k)]; }
  double slope(int k) const { return slope_[static_cast<std::size_t>(k)]; }

 private:
  static constexpr auto kCurvatures = Nodes<N>::curvatures();

  void cubic(int piece, double s) {
    const double h = Nodes<N>::width(piece), b = (s - Nodes<N>::at(piece)) / h, a = 1.0 - b;
    const auto i = static_cast<std::size_t>(piece);
    const Row &left = kCurvatures[i], &right = kCurvatures[i + 1];
    for (std::size_t j = 0; j <= N; ++j) {
      value_[j] = h * h / 6.0 * (a * (a * a - 1.0) * left[j] + b * (b * b - 1.0) * right[j]);
      slope_[j] = h / 6.0 * ((1.0 - 3.0 * a * a) * left[j] + (3.0 * b * b - 1.0) * right[j]);
    }
    value_[i] += a, value_[i + 1] += b;
    slope_[i] -= 1.0 / h, slope_[i + 1] += 1.0 / h;
  }

  void go_on(double past) {
    for (std::size_t j = 0; j <= N; ++j) value_[j] += slope_[j] * past;
  }

  void level_off(double past) {
    const double x = std::min(past, kLevelledOver), left = 1.0 - x / kLevelledOver;
    for (std::size_t j = 0; j <= N; ++j) {
      value_[j] += slope_[j] * x * (1.0 - 0.5 * x / kLevelledOver);
      slope_[j] *= left;
    }
  }

  Row value_{}, slope_{};
};

/// The curve through the nodes at a place.
/// @param value (int node) -> T
template <int N, Beyond beyond, class T, class Value>
T along_nodes(const T& s, const Value& value) {
  const NodeWeights<N, beyond> weights(value_of(s));
  T found(0.0);
  double slope = 0.0;
  for (int k = 0; k <= N; ++k) {
    const T here = value(k);
    found += weights.value(k) * here;
    slope += weights.slope(k) * value_of(here);
  }
  if constexpr (kIsJet<T>) found.v += slope * s.v;
  return found;
}

}  // namespace gapscope::internal::plant
