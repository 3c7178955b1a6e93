#include "signals/strokes.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::signals {
namespace {

/// Every turn, with the begin and the end of a recording that moves.
std::vector<StrokeTurn> ends_of_strokes(std::span<const double> x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double least = kReversal * (*high - *low);
  std::vector<StrokeTurn> ends{{0, 0}};
  StrokeTurn farthest;  // in the present direction
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (farthest.direction * (x[i] - x[farthest.sample]) > 0.0) farthest.sample = i;
    if (std::abs(x[i] - x[farthest.sample]) <= least) continue;
    const int direction = x[i] > x[farthest.sample] ? 1 : -1;
    if (farthest.direction != 0) ends.push_back({farthest.sample, direction});
    farthest = {i, direction};
  }
  if (farthest.direction == 0) return {};
  ends.push_back({farthest.sample, 0});
  return ends;
}

}  // namespace

std::vector<StrokeTurn> turns(std::span<const double> x) {
  const std::vector<StrokeTurn> ends = ends_of_strokes(x);
  return ends.empty() ? ends : std::vector(ends.begin() + 1, ends.end() - 1);
}

std::vector<double> strokes(std::span<const double> x) {
  const std::vector<StrokeTurn> ends = ends_of_strokes(x);
  std::vector<double> ways;
  for (std::size_t k = 1; k < ends.size(); ++k)
    ways.push_back(std::abs(x[ends[k].sample] - x[ends[k - 1].sample]));
  return ways;
}

}  // namespace gapscope::internal::signals
