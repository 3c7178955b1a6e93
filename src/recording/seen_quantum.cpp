#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "gapscope/recording/recording.h"

namespace gapscope {
namespace {

constexpr std::size_t kFewestSteps = 20;
constexpr std::size_t kFewPositions = 12;  ///< different ones; so few are counts, however they come
constexpr double kTextRounding = 1e-6;  ///< of the range: smaller steps come from printing, not from counting
constexpr double kCluster = 0.02;       ///< steps that differ by less than this share are the same step
constexpr double kOnGrid = 0.1;         ///< distance from a whole number of quanta that still is one
constexpr double kShareOnGrid = 0.9;    ///< chance alone puts 2 × kOnGrid of the steps on a grid
constexpr int kLargestFirstCount = 5;   ///< the smallest recurring step may be this many quanta
constexpr double kShareOfOneStep = 0.98;  ///< a motion of one and the same step is a ramp, not a count

/// Sizes of all steps that are none of text rounding, in rising order.
std::vector<double> sorted_steps(std::span<const double> x1) {
  std::vector<double> steps;
  if (x1.size() < 2) return steps;
  const auto [low, high] = std::minmax_element(x1.begin(), x1.end());
  const double smallest = kTextRounding * (*high - *low);
  for (std::size_t i = 1; i < x1.size(); ++i)
    if (const double step = std::abs(x1[i] - x1[i - 1]); step > smallest) steps.push_back(step);
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// The least distance between the positions of a recording that has hardly any; 0 if there are many, or one.
double between_few_positions(std::span<const double> x1) {
  std::set<double> positions;
  for (std::size_t i = 0; i < x1.size() && positions.size() <= kFewPositions; ++i) positions.insert(x1[i]);
  if (positions.size() < 2 || positions.size() > kFewPositions || x1.size() < kFewPositions * kFewPositions)
    return 0.0;
  double least = *positions.rbegin() - *positions.begin();
  for (auto p = positions.begin(), next = std::next(p); next != positions.end(); p = next++)
    least = std::min(least, *next - *p);
  return least;
}

/// The smallest step that `times` steps come close to; 0 if none.
double smallest_recurring(const std::vector<double>& steps, std::size_t times) {
  for (std::size_t i = 0; i + times <= steps.size(); ++i)
    if (steps[i + times - 1] <= steps[i] * (1.0 + kCluster)) return steps[i + times / 2];
  return 0.0;
}

/// The spacing of the grid that the steps lie on, near `guess`; 0 if they lie on none. The estimate
/// q = Σ n s / Σ n² is sharpened by ever larger steps s = n q.
/// @param standing  number of samples without a step
double grid_spacing(const std::vector<double>& steps, std::size_t standing, double guess) {
  double products = 0.0, squares = 0.0, q = guess, last = 0.0;
  std::size_t on_grid = 0, run = 0, longest_run = 0;
  for (const double step : steps) {
    const double n = std::round(step / q);
    if (n < 1.0 || std::abs(step / q - n) > kOnGrid) continue;
    ++on_grid;
    run = n == last ? run + 1 : 1;
    longest_run = std::max(longest_run, run);
    last = n;
    products += n * step;
    squares += n * n;
    q = products / squares;
  }
  const auto share = [](std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  };
  if (share(on_grid, steps.size()) < kShareOnGrid) return 0.0;
  return share(longest_run, steps.size() + standing) <= kShareOfOneStep ? q : 0.0;
}

}  // namespace

double seen_quantum(std::span<const double> x1) {
  if (const double q = between_few_positions(x1); q > 0.0) return q;
  const std::vector<double> steps = sorted_steps(x1);
  if (steps.size() < kFewestSteps) return 0.0;
  const std::size_t standing = x1.size() - 1 - steps.size();
  for (const std::size_t times : {std::size_t{3}, steps.size() / 1000 + 3}) {  // rare, or no stray step
    const double first = smallest_recurring(steps, times);
    for (int count = 1; first > 0.0 && count <= kLargestFirstCount; ++count)
      if (const double q = grid_spacing(steps, standing, first / count); q > 0.0) return q;
  }
  return 0.0;
}

}  // namespace gapscope
