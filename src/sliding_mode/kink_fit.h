#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gapscope::internal {

/// What begins at a kink, as a function of the samples x ≥ 0 since. A power x^p, or the stroke of an elastic
/// contact:
///   x − e^(−ζωx) sin(ω_d x)/ω_d,  ω_d = ω √(1 − ζ²),  until the rebound at ω_d x = π, a straight line after
///   it
/// (two free bodies that meet; it begins as x³ and x², and tends to the rigid impact x for large ω).
struct KinkShape {
  int power = 1;         ///< 0: elastic contact
  double omega = 0.0;    ///< ω [rad/sample]
  double damping = 0.0;  ///< ζ

  double operator()(double x) const;
};

/// Least squares of y(t) = P(t) + A shape(t − t_k)₊: a polynomial P of low degree, and from t_k on something
/// new.
struct KinkFit {
  double time = 0.0;  ///< t_k, in samples of the recording
  KinkShape shape;
  double amplitude = 0.0;  ///< A
  double sse = 0.0;        ///< sum of squared errors [rad²]
  double position = 0.0;   ///< P(t_k) [rad]
  double slope = 0.0;      ///< P'(t_k) [rad/sample]
  double curvature = 0.0;  ///< P''(t_k) [rad/sample²]
};

/// Samples first … first + y.size() − 1 of a recording, prepared for many trial kinks: the polynomial is
/// projected out once, each trial then costs one pass.
class KinkScan {
 public:
  /// @param degree  of P, 1 to 3.
  KinkScan(std::span<const double> y, std::size_t first, int degree);

  double smooth_sse() const { return smooth_sse_; }  ///< of P alone [rad²]
  std::size_t size() const { return residual_.size(); }

  /// Best kink of one shape with t_k in [from, to], tried every `step` samples, then finer around the best.
  KinkFit best(const KinkShape& shape, double from, double to, double step = 1.0) const;

 private:
  static constexpr std::size_t kColumns = 4;
  struct Trial {
    double sse, amplitude;
  };
  double scaled(std::size_t i) const { return (static_cast<double>(i) - middle_) / half_; }
  double basis(std::size_t column, double tau) const;
  std::array<double, 3> derivatives(const std::array<double, kColumns>& weights, double tau) const;
  Trial trial(const KinkShape& shape, double time, std::array<double, kColumns>* weights) const;
  KinkFit finish(const KinkShape& shape, double time) const;

  std::size_t first_;
  std::size_t columns_;
  double middle_ = 0.0, half_ = 1.0;
  std::array<std::array<double, kColumns>, kColumns> recipe_{};  // orthonormal columns as monomials of tau
  std::vector<double> basis_;                                    // (n_samples × columns)
  std::array<double, kColumns> weights_{};                       // of y in the basis
  std::vector<double> residual_;
  double smooth_sse_ = 0.0;
};

}  // namespace gapscope::internal
