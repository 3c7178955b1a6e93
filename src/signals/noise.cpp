#include "signals/noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kSquares = 70.0;  ///< Σ binomial(4, i)²
constexpr std::size_t kPoints = 5;
constexpr std::size_t kWindow = 16, kFewestWindows = 4;
constexpr std::size_t kSlowPart = 4;  ///< of so many windows one counts as at rest

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

namespace {

/// Differences of five samples in which white noise of σ leaves σ.
std::vector<double> noise_differences(std::span<const double> y, std::span<const double> stamps) {
  std::vector<double> d;
  if (stamps.empty()) {
    d = fourth_differences(y);
    for (double& v : d) v /= std::sqrt(kSquares);
  }
  for (std::size_t i = 0; i + kPoints <= stamps.size(); ++i)
    d.push_back(divided_difference(y.subspan(i, kPoints), stamps.subspan(i, kPoints)));
  return d;
}

}  // namespace

double noise_at_rest(std::span<const double> y, std::span<const double> stamps) {
  const std::vector<double> d = noise_differences(y, stamps);
  const auto window = [&](std::size_t w) { return std::span(d).subspan(w * kWindow, kWindow); };
  std::vector<std::pair<double, std::size_t>> travels;
  for (std::size_t w = 0; (w + 1) * kWindow <= d.size(); ++w) {
    const auto part = y.subspan(w * kWindow, kWindow);
    const auto [low, high] = std::minmax_element(part.begin(), part.end());
    travels.emplace_back(*high - *low, w);
  }
  const std::size_t slow = travels.size() / kSlowPart;
  if (slow < kFewestWindows) return robust_std(d);
  std::nth_element(travels.begin(), travels.begin() + static_cast<std::ptrdiff_t>(slow), travels.end());
  std::vector<double> slowest;
  for (std::size_t i = 0; i < slow; ++i) {
    const auto part = window(travels[i].second);
    slowest.insert(slowest.end(), part.begin(), part.end());
  }
  return robust_std(slowest);
}

}  // namespace gapscope::internal::signals
