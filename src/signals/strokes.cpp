#include "signals/strokes.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::signals {

std::vector<double> strokes(std::span<const double> positions) {
  const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
  const double least = kReversal * (*high - *low);
  std::vector<double> ways;
  int direction = 0;
  double begin = positions.front(), turn = begin;  // the farthest position in the present direction
  for (const double x : positions) {
    if (direction * (x - turn) > 0.0) turn = x;
    if (std::abs(x - turn) <= least) continue;
    if (direction != 0) ways.push_back(std::abs(turn - begin)), begin = turn;
    direction = x > turn ? 1 : -1, turn = x;
  }
  if (direction != 0) ways.push_back(std::abs(turn - begin));
  return ways;
}

}  // namespace gapscope::internal::signals
