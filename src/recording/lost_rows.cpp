#include "recording/lost_rows.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

constexpr double kLossBegins = 1.5;  ///< usual steps
constexpr std::size_t kAround = 10;  ///< steps to either side that are looked at

/// The median of the steps around one, without it.
double usual_around(std::span<const double> steps, std::size_t i) {
  std::vector<double> near;
  const std::size_t first = i < kAround ? 0 : i - kAround, last = std::min(i + kAround + 1, steps.size());
  for (std::size_t j = first; j < last; ++j)
    if (j != i) near.push_back(steps[j]);
  return near.empty() ? steps[i] : median(std::move(near));
}

}  // namespace

std::vector<Loss> losses_of(std::span<const double> t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::vector<Loss> losses;
  if (steps.empty()) return losses;
  const double usual = median(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] <= kLossBegins * usual) continue;
    const double here = std::max(usual, usual_around(steps, i));
    if (steps[i] <= kLossBegins * here) continue;
    const double rows = std::min(std::max(std::round(steps[i] / here), 2.0), 2e9);
    losses.push_back({i, static_cast<std::size_t>(rows) - 1});
  }
  return losses;
}

std::size_t lost_rows(const Recording& r) {
  std::size_t lost = 0;
  for (const Loss& loss : losses_of(r.stamps)) lost += loss.lost;
  return lost;
}

std::size_t bridge_lost_rows(Recording& r) {
  std::size_t bridged = 0;
  for (const Loss& loss : losses_of(r.stamps)) {
    bridge(loss, r.u);
    bridged += loss.lost;
  }
  return bridged;
}

}  // namespace gapscope
