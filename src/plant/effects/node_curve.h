#pragma once

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "gapscope/plant/scalar.h"

namespace gapscope::internal::plant {

/// Where a curve over [0, 1] with nodes at (k/N)², k = 0 ... N, is evaluated: closer nodes where most laws of
/// friction and of inputs bend.
template <int N>
struct NodePlace {
  int piece = N;       ///< from node `piece` to the next; N: at the last node or beyond
  double along = 0.0;  ///< in the piece, from 0 to 1
  double width = 1.0;  ///< of the piece

  explicit NodePlace(double s) {
    if (!(s < 1.0)) return;
    piece = std::clamp(static_cast<int>(N * std::sqrt(std::max(s, 0.0))), 0, N - 1);
    width = node(piece + 1) - node(piece);
    along = (s - node(piece)) / width;
  }

  static constexpr double node(int k) { return static_cast<double>(k * k) / (N * N); }
};

/// Lines from node to node, constant from the last one on; a parabola rounds each corner over a quarter of
/// the shorter piece beside it, so that the slope is continuous and each piece rises or falls throughout.
/// @param value (int node) -> T
template <int N, class T, class Value>
T along_nodes(const T& s, const Value& value) {
  constexpr double kRounded = 0.25;
  const NodePlace<N> at(value_of(s));
  if (at.piece == N && value_of(s) >= 1.0 + kRounded * (1.0 - NodePlace<N>::node(N - 1))) return value(N);
  const auto slope = [&](int piece) {
    if (piece < 0 || piece >= N) return T(0.0);
    return T((value(piece + 1) - value(piece)) / (NodePlace<N>::node(piece + 1) - NodePlace<N>::node(piece)));
  };
  const auto width = [](int piece) {
    return piece >= N ? kInfinity : NodePlace<N>::node(piece + 1) - NodePlace<N>::node(piece);
  };
  const T own = slope(at.piece);
  T found = value(at.piece) + own * (s - NodePlace<N>::node(at.piece));
  for (const int corner : {at.piece, at.piece + 1}) {  // the one before and the one after
    if (corner == 0 || corner > N) continue;
    const double reach = kRounded * std::min(width(corner - 1), width(corner));
    const T beyond = s - NodePlace<N>::node(corner);
    const T into = corner == at.piece ? T(reach - beyond) : T(reach + beyond);
    if (!(value_of(into) > 0.0)) continue;
    const T bend = slope(corner) - slope(corner - 1);
    found += bend * into * into * (0.25 / reach);
  }
  return found;
}

}  // namespace gapscope::internal::plant
