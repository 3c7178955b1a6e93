#include "report/budget_band.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// Top of the band times the length of a mean that passes half its power.
constexpr double kHalfPower = 0.443;
constexpr double kDrawn = 0.99;          ///< share of the values that an axis shows at least
constexpr double kFarBeyondShare = 1.5;  ///< times that share's reach: nearer ones are drawn all

/// Samples on either side of the mean; 0: nothing is taken off.
std::size_t band_reach(const ErrorBudget& budget, const MismatchTrace& t) {
  if (!budget.exists() || t.x1.size() < 2) return 0;
  const double dt = (t.time(t.x1.size() - 1) - t.time(0)) / static_cast<double>(t.x1.size() - 1);
  return static_cast<std::size_t>(0.5 * kHalfPower / (budget.band_hz * dt));
}

}  // namespace

std::vector<double> within_band(const ErrorBudget& budget, const MismatchTrace& trace,
                                const std::vector<double>& values) {
  const std::size_t reach = band_reach(budget, trace), first = std::min(trace.scored_from, values.size());
  if (reach == 0) return values;
  std::vector<double> sums = {0.0}, counts = {0.0}, means(values.size(), kNaN);
  for (std::size_t i = first; i < values.size(); ++i) {
    const bool known = std::isfinite(values[i]);
    sums.push_back(sums.back() + (known ? values[i] : 0.0)),
        counts.push_back(counts.back() + (known ? 1.0 : 0.0));
  }
  const bool whole = values.size() - first > 2 * reach;
  for (std::size_t i = first; i < values.size(); ++i) {
    const std::size_t k = i - first, r = std::min({reach, k, values.size() - 1 - i});
    if (std::isfinite(values[i]) && (r == reach || !whole))
      means[i] = (sums[k + r + 1] - sums[k - r]) / (counts[k + r + 1] - counts[k - r]);
  }
  return means;
}

std::string band_words(const ErrorBudget& budget, const MismatchTrace& trace) {
  return band_reach(budget, trace) == 0 ? "" : " below " + rounded(budget.band_hz, 2) + " Hz";
}

double draw_means_of_a_block(std::vector<Series>& lines) {
  const Stretches last = stretches_of(lines.back().y);
  if (!last.are_a_block()) return 0.0;
  double length = 0.0;
  for (Series& s : lines) {
    const Stretches parts = stretches_of(s.y);
    std::vector<double> middles;
    for (std::size_t i = 0; i < parts.means.size(); ++i)
      middles.push_back(0.5 * (s.x[i * parts.each] + s.x[(i + 1) * parts.each - 1]));
    length = s.x[parts.each] - s.x[0];
    s.x = std::move(middles), s.y = parts.means;
  }
  return length;
}

double informative_reach(const std::vector<double>& values, double least) {
  std::vector<double> sizes;
  for (const double v : values)
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  if (sizes.empty()) return 0.0;
  const double all = *std::max_element(sizes.begin(), sizes.end());
  const double most = std::max(quantile(std::move(sizes), kDrawn), std::min(least, all));
  return all > kFarBeyondShare * most ? most : all;
}

}  // namespace gapscope::internal::report
