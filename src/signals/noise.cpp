#include "signals/noise.h"

#include <cmath>
#include <utility>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kSquares = 70.0;  ///< Σ binomial(4, i)²

}  // namespace

std::vector<double> fourth_differences(std::span<const double> y) {
  std::vector<double> d;
  d.reserve(y.size());
  for (std::size_t i = 4; i < y.size(); ++i)
    d.push_back(y[i] - 4.0 * y[i - 1] + 6.0 * y[i - 2] - 4.0 * y[i - 3] + y[i - 4]);
  return d;
}

double noise_from_differences(std::span<const double> y) {
  std::vector<double> d = fourth_differences(y);
  for (double& v : d) v = std::abs(v);
  return 1.4826 * median(std::move(d)) / std::sqrt(kSquares);
}

double noise_from_spread(std::span<const double> y) {
  std::vector<double> d = fourth_differences(y);
  for (double& v : d) v /= std::sqrt(kSquares);
  return robust_std(d);
}

}  // namespace gapscope::internal::signals
