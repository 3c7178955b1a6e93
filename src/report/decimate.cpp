#include "report/decimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gapscope::internal::report {
namespace {

/// Adds first, extremes and last of the samples [begin, end) in order, each once.
void keep_extremes(std::span<const double> y, std::size_t begin, std::size_t end,
                   std::vector<std::size_t>& kept) {
  std::size_t low = begin, high = begin;
  for (std::size_t i = begin; i < end; ++i) {
    if (y[i] < y[low] || std::isnan(y[low])) low = i;
    if (y[i] > y[high] || std::isnan(y[high])) high = i;
  }
  std::size_t four[] = {begin, std::min(low, high), std::max(low, high), end - 1};
  for (const std::size_t i : four)
    if (kept.empty() || kept.back() < i) kept.push_back(i);
}

}  // namespace

std::vector<std::size_t> decimate_columns(std::span<const double> x, std::span<const double> y,
                                          std::size_t columns) {
  std::vector<std::size_t> kept;
  const std::size_t n = x.size();
  if (n <= 4 * columns || !(x.back() > x.front())) {
    kept.resize(n);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const double per_unit = static_cast<double>(columns) / (x.back() - x.front());
  const auto column = [&](std::size_t i) { return std::floor((x[i] - x.front()) * per_unit); };
  for (std::size_t begin = 0; begin < n;) {
    std::size_t end = begin + 1;
    while (end < n && column(end) == column(begin)) ++end;
    keep_extremes(y, begin, end, kept);
    begin = end;
  }
  return kept;
}

Polyline thin_out(const Polyline& line, double distance) {
  Polyline kept;
  for (const Point& p : line)
    if (kept.empty() || std::hypot(p.x - kept.back().x, p.y - kept.back().y) >= distance) kept.push_back(p);
  if (!line.empty() && (kept.back().x != line.back().x || kept.back().y != line.back().y))
    kept.push_back(line.back());
  return kept;
}

}  // namespace gapscope::internal::report
