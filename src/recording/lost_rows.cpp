#include "gapscope/recording/lost_rows.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

/// Steps longer than this many median steps have lost a row, as `check` says, too.
constexpr double kLossBegins = 1.5;

/// Calls for each step with a loss: its row and how many rows it would have had.
template <class Take>
void for_each_loss(const Recording& r, Take take) {
  if (r.stamps.size() < 2) return;
  std::vector<double> steps;
  for (std::size_t i = 1; i < r.stamps.size(); ++i) steps.push_back(r.stamps[i] - r.stamps[i - 1]);
  const double usual = median(steps);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > kLossBegins * usual) take(i, std::max(std::round(steps[i] / usual), 2.0));
}

}  // namespace

std::size_t lost_rows(const Recording& r) {
  std::size_t lost = 0;
  for_each_loss(r, [&](std::size_t, double rows) { lost += static_cast<std::size_t>(rows) - 1; });
  return lost;
}

std::size_t bridge_lost_rows(Recording& r) {
  std::size_t bridged = 0;
  for_each_loss(r, [&](std::size_t i, double rows) {
    r.u[i] += (r.u[i + 1] - r.u[i]) * (rows - 1.0) / (2.0 * rows);
    bridged += static_cast<std::size_t>(rows) - 1;
  });
  return bridged;
}

}  // namespace gapscope
