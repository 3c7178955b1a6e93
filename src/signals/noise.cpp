#include "signals/noise.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kSquares = 70.0;  ///< Σ binomial(4, i)²
/// Of the differences that leave the noise about a motion: of one at a sixth of the sampling rate the eighth
/// ones leave a sixteenth of what the fourth do, of slower ones less, and whole counts fall on so many values
/// that their median is no step.
constexpr std::size_t kPoints = 9;

/// c_k ∝ 1/Π (t_k − t_j) with Σ c_k² = 1: of Σ c_k y_k a polynomial of the seventh degree drops out, white
/// noise stays.
std::array<double, kPoints> divided_difference(std::span<const double> t) {
  std::array<double, kPoints> c{};
  double square = 0.0;
  const double length = t[kPoints - 1] - t[0];
  for (std::size_t k = 0; k < kPoints; ++k) {
    double product = 1.0;
    for (std::size_t j = 0; j < kPoints; ++j)
      if (j != k) product *= (t[k] - t[j]) / length;
    c[k] = 1.0 / product, square += c[k] * c[k];
  }
  for (double& v : c) v /= std::sqrt(square);
  return c;
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

double noise_about_motion(std::span<const double> y, std::span<const double> stamps) {
  std::array<double, kPoints> even{};
  std::iota(even.begin(), even.end(), 0.0);
  std::array<double, kPoints> c = divided_difference(even);
  std::vector<double> d;
  for (std::size_t i = 0; i + kPoints <= y.size(); ++i) {
    if (!stamps.empty()) c = divided_difference(stamps.subspan(i, kPoints));
    d.push_back(std::inner_product(c.begin(), c.end(), y.begin() + static_cast<std::ptrdiff_t>(i), 0.0));
  }
  return robust_std(d);
}

}  // namespace gapscope::internal::signals
