#include "signals/noise.h"

#include <cmath>
#include <utility>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kSquares = 70.0;  ///< Σ binomial(4, i)²
constexpr std::size_t kPoints = 5;

/// Σ c_k y_k over five samples with Σ c_k² = 1 and c_k ∝ 1/Π (t_k − t_j): a cubic drops out, white noise
/// stays.
double divided_difference(std::span<const double> y, std::span<const double> t) {
  double sum = 0.0, square = 0.0;
  const double length = t[kPoints - 1] - t[0];
  for (std::size_t k = 0; k < kPoints; ++k) {
    double product = 1.0;
    for (std::size_t j = 0; j < kPoints; ++j)
      if (j != k) product *= (t[k] - t[j]) / length;
    sum += y[k] / product, square += 1.0 / (product * product);
  }
  return sum / std::sqrt(square);
}

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

double noise_from_spread(std::span<const double> y, std::span<const double> stamps) {
  if (!stamps.empty()) {
    std::vector<double> of_stamps;
    for (std::size_t i = 0; i + kPoints <= y.size(); ++i)
      of_stamps.push_back(divided_difference(y.subspan(i, kPoints), stamps.subspan(i, kPoints)));
    return robust_std(of_stamps);
  }
  std::vector<double> d = fourth_differences(y);
  for (double& v : d) v /= std::sqrt(kSquares);
  return robust_std(d);
}

}  // namespace gapscope::internal::signals
