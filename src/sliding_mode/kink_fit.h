#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace gapscope::internal::sliding_mode {

/// What begins at a kink, as a function of the samples x ≥ 0 since. A power x^p, or the stroke of an elastic
/// contact:
///   x − e^(−ζωx) sin(ω_d x)/ω_d,  ω_d = ω √(1 − ζ²),  until the rebound at ω_d x = π, a straight line after
///   it
/// (two free bodies that meet; it begins as x³ and x², and tends to the rigid impact x for large ω). Or an
/// impact whose first knock takes the share ρ of the speed that is lost, and the bounces after it the rest:
///   x − (1 − ρ)(1 − e^(−λx))/λ.
struct KinkShape {
  int power = 1;         ///< 0: elastic contact, or bounces
  double omega = 0.0;    ///< ω [rad/sample]
  double damping = 0.0;  ///< ζ
  double first = 0.0;    ///< ρ; 0: no bounces
  double fading = 0.0;   ///< λ [1/sample]

  double operator()(double x) const;
};

/// The values of a shape at x, x + step, … (an elastic stroke turns and fades by the same factor every step).
class ShapeWalk {
 public:
  ShapeWalk(const KinkShape& shape, double x, double step = 1.0);
  double next() {
    const double value = shape_.power != 0    ? shape_(x_)
                         : shape_.first > 0.0 ? x_ + (1.0 - shape_.first) * (z_.real() - 1.0) / shape_.fading
                         : x_ < end_          ? x_ - z_.imag() / damped_
                                              : end_ + after_ * (x_ - end_);
    z_ = {z_.real() * turn_.real() - z_.imag() * turn_.imag(),
          z_.real() * turn_.imag() + z_.imag() * turn_.real()};
    x_ += step_;
    return value;
  }

 private:
  KinkShape shape_;
  double x_, step_, damped_ = 1.0, end_ = 0.0, after_ = 1.0;
  std::complex<double> turn_, z_;
};

/// Least squares of y(t) = P(t) + A shape(t − t_k)₊: P in the span of some columns, and from t_k on something
/// new.
struct KinkFit {
  double time = 0.0;  ///< t_k, in samples of the recording
  KinkShape shape;
  double amplitude = 0.0;  ///< A
  double sse = 0.0;        ///< sum of squared errors [rad²]

  double operator()(double t) const { return t > time ? amplitude * shape(t - time) : 0.0; }
};

/// The trial(x) of least `sse` with x in [from, to], tried every `step`, then finer around the best down to
/// `finest`.
template <class Trial>
auto least_sse(const Trial& trial, double from, double to, double step, double finest) {
  double at = from;
  auto least = trial(from);
  const auto visit = [&](double x) {
    if (x < from || x > to) return;
    if (const auto fit = trial(x); fit.sse < least.sse) least = fit, at = x;
  };
  for (double x = from; x <= to; x += step) visit(x);
  for (double fine = 0.5 * step; fine > finest; fine *= 0.5) {
    const double centre = at;
    visit(centre - fine);
    visit(centre + fine);
  }
  return least;
}

/// 1, t, … t^degree at n samples (n × degree + 1).
Eigen::MatrixXd polynomial_columns(std::size_t n, int degree);

/// Samples first … first + y.size() − 1 of a recording, prepared for many trial kinks: the columns are
/// projected out once, each trial then costs one pass over what follows the kink.
class KinkScan {
 public:
  /// @param columns  that span P (y.size() × at most 8); they may depend on each other.
  KinkScan(std::span<const double> y, std::size_t first, const Eigen::MatrixXd& columns);

  double smooth_sse() const { return smooth_sse_; }  ///< of P alone [rad²]
  std::size_t size() const { return residual_.size(); }

  /// Best kink of one shape with t_k in [from, to], tried every `step` samples, then finer around the best.
  KinkFit best(const KinkShape& shape, double from, double to, double step = 1.0) const;

 private:
  static constexpr int kMostColumns = 8;
  KinkFit trial(const KinkShape& shape, double time) const;

  std::size_t first_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> basis_;  // orthonormal
  std::vector<double> residual_;
  double smooth_sse_ = 0.0;
};

}  // namespace gapscope::internal::sliding_mode
