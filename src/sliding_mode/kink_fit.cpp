#include "sliding_mode/kink_fit.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/require.h"

namespace gapscope::internal {
namespace {

double power_of(double x, int p) { return p == 1 ? x : p == 2 ? x * x : x * x * x; }

}  // namespace

KinkScan::KinkScan(std::span<const double> y, std::size_t first, int degree)
    : first_(first), columns_(static_cast<std::size_t>(degree) + 1), residual_(y.begin(), y.end()) {
  GAPSCOPE_REQUIRE(degree >= 1 && degree <= 3 && y.size() > columns_ + 1);
  const std::size_t n = y.size();
  middle_ = 0.5 * static_cast<double>(n - 1);
  half_ = std::max(middle_, 1.0);
  basis_.resize(n * columns_);
  for (std::size_t c = 0; c < columns_; ++c) {  // Gram–Schmidt on the monomials, keeping the recipe
    recipe_[c][c] = 1.0;
    for (std::size_t pass = 0; pass < 2 * c; ++pass) {  // twice over the earlier columns: exact to round-off
      const std::size_t b = pass % c;
      double dot = 0.0;
      for (std::size_t i = 0; i < n; ++i) dot += basis(c, scaled(i)) * basis_[i * columns_ + b];
      for (std::size_t k = 0; k <= b; ++k) recipe_[c][k] -= dot * recipe_[b][k];
    }
    double norm = 0.0;
    for (std::size_t i = 0; i < n; ++i) norm += std::pow(basis(c, scaled(i)), 2);
    for (double& r : recipe_[c]) r /= std::sqrt(norm);
    for (std::size_t i = 0; i < n; ++i) basis_[i * columns_ + c] = basis(c, scaled(i));
  }
  for (std::size_t c = 0; c < columns_; ++c) {
    for (std::size_t i = 0; i < n; ++i) weights_[c] += residual_[i] * basis_[i * columns_ + c];
    for (std::size_t i = 0; i < n; ++i) residual_[i] -= weights_[c] * basis_[i * columns_ + c];
  }
  for (const double r : residual_) smooth_sse_ += r * r;
}

double KinkScan::basis(std::size_t column, double tau) const {
  const auto& r = recipe_[column];
  return r[0] + tau * (r[1] + tau * (r[2] + tau * r[3]));
}

std::array<double, 3> KinkScan::derivatives(const std::array<double, kColumns>& weights, double tau) const {
  std::array<double, kColumns> m{};
  for (std::size_t c = 0; c < columns_; ++c)
    for (std::size_t k = 0; k < kColumns; ++k) m[k] += weights[c] * recipe_[c][k];
  return {m[0] + tau * (m[1] + tau * (m[2] + tau * m[3])),
          (m[1] + tau * (2.0 * m[2] + tau * 3.0 * m[3])) / half_,
          (2.0 * m[2] + 6.0 * tau * m[3]) / (half_ * half_)};
}

KinkScan::Trial KinkScan::trial(int power, double time, std::array<double, kColumns>* weights) const {
  const double local = time - static_cast<double>(first_);
  const auto begin = static_cast<std::size_t>(std::max(std::ceil(local), 0.0));
  std::array<double, kColumns> dots{};
  double square = 0.0, with_residual = 0.0;
  for (std::size_t i = begin; i < size(); ++i) {
    const double c = power_of(static_cast<double>(i) - local, power);
    square += c * c;
    with_residual += c * residual_[i];
    for (std::size_t k = 0; k < columns_; ++k) dots[k] += c * basis_[i * columns_ + k];
  }
  double left = square;  // squared length of what the polynomial cannot imitate
  for (std::size_t k = 0; k < columns_; ++k) left -= dots[k] * dots[k];
  if (weights != nullptr) *weights = dots;
  if (!(left > 1e-9 * square)) return {smooth_sse_, 0.0};
  const double amplitude = with_residual / left;
  return {std::max(smooth_sse_ - amplitude * with_residual, 0.0), amplitude};
}

KinkFit KinkScan::finish(int power, double time) const {
  std::array<double, kColumns> dots{};
  const Trial t = trial(power, time, &dots);
  std::array<double, kColumns> weights = weights_;
  for (std::size_t k = 0; k < columns_; ++k) weights[k] -= t.amplitude * dots[k];
  const double tau = (time - static_cast<double>(first_) - middle_) / half_;
  const auto d = derivatives(weights, tau);
  return {time, power, t.amplitude, t.sse, d[0], d[1], d[2]};
}

KinkFit KinkScan::best(int power, double from, double to, double step) const {
  double time = from, least = trial(power, from, nullptr).sse;
  const auto visit = [&](double t) {
    if (t < from || t > to) return;
    const double sse = trial(power, t, nullptr).sse;
    if (sse < least) least = sse, time = t;
  };
  for (double t = from; t <= to; t += step) visit(t);
  for (double fine = 0.5 * step; fine > 0.1; fine *= 0.5) {
    const double centre = time;
    visit(centre - fine);
    visit(centre + fine);
  }
  return finish(power, time);
}

}  // namespace gapscope::internal
