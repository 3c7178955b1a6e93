#include "sliding_mode/verdict/loop_shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kBins = 20;   ///< of a branch, over twice the amplitude
constexpr std::size_t kLoaded = 5;  ///< of them, at its end: the loaded flank
constexpr double kFlank = 0.75;     ///< quantile of the flank's bins that goes with u: in some x1 sticks
constexpr std::size_t kRun = 4;     ///< of them, within which a free run lies: detents spread it
constexpr double kBinReach = 0.98;  ///< of the amplitude that the bins cover
constexpr double kFree = 10.0;      ///< compliance where x1 runs free, over that of the rest of a branch

using Steps = std::vector<double>;  ///< travel within each bin, along the branch [rad]

Steps steps_of(const LoopBranch& b, double amplitude) {
  const auto x = signals::branch_positions(*b.trace, *b.cycles, b.crossing, kBinReach * amplitude, kBins);
  Steps steps;
  for (std::size_t k = 1; k < x.size(); ++k) steps.push_back(x[k] - x[k - 1]);
  return steps;
}

/// Range of x1 from one extreme of the input over the next.
double travel_of(const LoopBranch& b) {
  const auto& all = b.cycles->crossings;
  const std::size_t from = b.crossing > 0 ? all[b.crossing - 1].sample : 0;
  const std::size_t to = b.crossing + 1 < all.size() ? all[b.crossing + 1].sample : b.trace->size();
  const auto [low, high] = std::ranges::minmax(b.trace->x1.subspan(from, to - from));
  return high - low;
}

/// Travel within the bins in which x1 moves by more than `least`, median over the branches.
double run_beyond(double least, const std::vector<Steps>& branches) {
  std::vector<double> runs;
  for (const Steps& steps : branches) {
    double run = 0.0;
    for (const double step : steps) run += step > least ? step : 0.0;
    runs.push_back(run);
  }
  return median(std::move(runs));
}

double move_at(const Steps& steps, std::size_t k, std::size_t bins) {
  double sum = 0.0;
  for (std::size_t i = k; i < k + bins; ++i) sum += steps[i];
  return sum;
}

/// Where x1 moves farthest over so many neighbouring bins.
std::size_t largest_move(const Steps& steps, std::size_t bins) {
  std::size_t at = 0;
  for (std::size_t k = 0; k + bins <= steps.size(); ++k)
    if (move_at(steps, k, bins) > move_at(steps, at, bins)) at = k;
  return at;
}

/// The largest move over two bins, over the largest one that has no bin in common with it.
double alone_in(const Steps& steps, double resolution) {
  const std::size_t at = largest_move(steps, 2);
  double next = 3.0 * resolution;
  for (std::size_t k = 0; k + 2 <= steps.size(); ++k)
    if (k + 2 <= at || k >= at + 2) next = std::max(next, move_at(steps, k, 2));
  return next > 0.0 ? move_at(steps, at, 2) / next : kInfinity;
}

/// Travel within a bin, on the mean over those beside the largest move.
double elsewhere(const Steps& steps) {
  double sum = -move_at(steps, largest_move(steps, kRun), kRun);
  for (const double step : steps) sum += step;
  return sum / static_cast<double>(steps.size() - kRun);
}

}  // namespace

double LoopBranch::amplitude() const {
  return std::min(cycles->crossings[crossing].before, cycles->crossings[crossing].after);
}

bool within_level(double amplitude, double level) {
  return amplitude >= level && amplitude <= kSameLevel * level;
}

LoopShape read_shape(std::span<const LoopBranch> branches, double amplitude, double resolution,
                     double least_way) {
  LoopShape shape;
  std::vector<Steps> all;
  std::vector<double> flanks, ends, rests, travels, alone;
  for (const LoopBranch& b : branches) {
    if (!within_level(b.amplitude(), 0.999 * amplitude)) continue;
    const Steps steps = steps_of(b, amplitude);
    if (steps.empty()) continue;
    flanks.push_back(quantile({steps.end() - kLoaded, steps.end()}, kFlank));
    ends.push_back(steps.back());
    rests.push_back(elsewhere(steps));
    travels.push_back(travel_of(b));
    alone.push_back(alone_in(steps, resolution));
    all.push_back(steps);
  }
  shape.visible = shape.stands_out = kInfinity;
  if (all.empty()) return shape;
  const auto least = [&](double stiff) { return kFree * std::max(stiff, 0.0) + 3.0 * resolution; };
  const double run = least(median(rests));  // within a bin
  const double end = least(median(ends));
  shape.flank = std::max(median(flanks), 0.0) * static_cast<double>(kBins) / (2.0 * kBinReach * amplitude);
  shape.free_run = run_beyond(run, all);
  shape.sure_run = run_beyond(std::max(end, least_way), all);
  shape.alone = median(alone);
  shape.travel = median(travels);
  shape.visible = std::max(2.0 * run, kFinest * resolution);  // a gap may end in the next bin
  shape.stands_out = std::max(2.0 * end, kFinest * resolution);
  return shape;
}

}  // namespace gapscope::internal::sliding_mode
