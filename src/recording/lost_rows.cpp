#include "recording/lost_rows.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

constexpr double kLossBegins = 1.5;  ///< usual steps, of a step; half a step, of what comes after it
constexpr std::size_t kAround = 10;  ///< steps to either side that are looked at

/// A longer step is a pause and no measure of the others [median steps]: one row may be missing in them. With
/// half of it the stamps in whole ms of 1.5 ms steps have lost half of the rows, with twice a row beside four
/// lost ones none.
constexpr double kPause = 2.5;

/// Stamps to either side of which the mean is taken: a stamp that is off by a fifth of a step says so to a
/// tenth. With half one in a hundred such stamps has a row lost before it, twice hides no loss.
constexpr std::size_t kMeant = 5;

/// The mean of the steps but one that are no pauses.
double usual_of(std::span<const double> steps, std::size_t but) {
  std::vector<double> others;
  for (std::size_t j = 0; j < steps.size(); ++j)
    if (j != but) others.push_back(steps[j]);
  if (others.empty()) return steps[but];
  const double longest = kPause * median(others);
  std::erase_if(others, [&](double step) { return step > longest; });
  return mean(others);
}

/// By how much the stamps from `row + 1` on are later than those up to `row` and one usual step after the
/// other say. A stamp that is late alone is made up for by the next ones; what is lost stays lost.
double later_by(std::span<const double> t, std::size_t row, double usual) {
  const std::size_t n = std::min({kMeant, row + 1, t.size() - row - 1});
  return mean(t.subspan(row + 1, n)) - mean(t.subspan(row + 1 - n, n)) - static_cast<double>(n) * usual;
}

}  // namespace

std::vector<Loss> losses_of(std::span<const double> t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::vector<Loss> losses;
  if (steps.empty()) return losses;
  const double usual = usual_of(steps, steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] <= kLossBegins * usual) continue;
    const std::size_t first = i < kAround ? 0 : i - kAround, last = std::min(i + kAround + 1, steps.size());
    const double here = std::max(usual, usual_of(std::span(steps).subspan(first, last - first), i - first));
    if (steps[i] <= kLossBegins * here || later_by(t, i, here) < (kLossBegins - 1.0) * here) continue;
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
