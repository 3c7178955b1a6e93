#include "sliding_mode/kink_fit.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/require.h"

namespace gapscope::internal {
double KinkShape::operator()(double x) const {
  if (power == 1) return x;
  if (power == 2) return x * x;
  if (power == 3) return x * x * x;
  const double damped = omega * std::sqrt(1.0 - damping * damping);
  const double end = std::acos(-1.0) / damped;
  if (x < end) return x - std::exp(-damping * omega * x) * std::sin(damped * x) / damped;
  return end + (1.0 + std::exp(-damping * omega * end)) * (x - end);
}

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

KinkScan::Trial KinkScan::trial(const KinkShape& shape, double time,
                                std::array<double, kColumns>* weights) const {
  const double local = time - static_cast<double>(first_);
  const auto begin = static_cast<std::size_t>(std::max(std::ceil(local), 0.0));
  std::array<double, kColumns> dots{};
  double square = 0.0, with_residual = 0.0;
  for (std::size_t i = begin; i < size(); ++i) {
    const double c = shape(static_cast<double>(i) - local);
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

KinkFit KinkScan::finish(const KinkShape& shape, double time) const {
  std::array<double, kColumns> dots{};
  const Trial t = trial(shape, time, &dots);
  std::array<double, kColumns> weights = weights_;
  for (std::size_t k = 0; k < columns_; ++k) weights[k] -= t.amplitude * dots[k];
  const double tau = (time - static_cast<double>(first_) - middle_) / half_;
  const auto d = derivatives(weights, tau);
  return {time, shape, t.amplitude, t.sse, d[0], d[1], d[2]};
}

KinkFit KinkScan::best(const KinkShape& shape, double from, double to, double step) const {
  double time = from, least = trial(shape, from, nullptr).sse;
  const auto visit = [&](double t) {
    if (t < from || t > to) return;
    const double sse = trial(shape, t, nullptr).sse;
    if (sse < least) least = sse, time = t;
  };
  for (double t = from; t <= to; t += step) visit(t);
  for (double fine = 0.5 * step; fine > 0.1; fine *= 0.5) {
    const double centre = time;
    visit(centre - fine);
    visit(centre + fine);
  }
  return finish(shape, time);
}

}  // namespace gapscope::internal
