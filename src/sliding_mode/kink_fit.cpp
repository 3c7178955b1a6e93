#include "sliding_mode/kink_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
double KinkShape::operator()(double x) const {
  if (power == 1) return x;
  if (power == 2) return x * x;
  if (power == 3) return x * x * x;
  if (first > 0.0) return x + (1.0 - first) * std::expm1(-fading * x) / fading;
  const double damped = omega * std::sqrt(1.0 - damping * damping);
  const double end = std::acos(-1.0) / damped;
  if (x < end) return x - std::exp(-damping * omega * x) * std::sin(damped * x) / damped;
  return end + (1.0 + std::exp(-damping * omega * end)) * (x - end);
}

ShapeWalk::ShapeWalk(const KinkShape& shape, double x, double step) : shape_(shape), x_(x), step_(step) {
  if (shape.power != 0) return;
  if (shape.first > 0.0) {
    turn_ = std::exp(-shape.fading * step);
    z_ = std::exp(-shape.fading * x);
    return;
  }
  damped_ = shape.omega * std::sqrt(1.0 - shape.damping * shape.damping);
  end_ = kPi / damped_;
  after_ = 1.0 + std::exp(-shape.damping * shape.omega * end_);
  turn_ = std::polar(std::exp(-shape.damping * shape.omega * step), damped_ * step);
  z_ = std::polar(std::exp(-shape.damping * shape.omega * x), damped_ * x);
}

namespace {

/// Of the values of a shape: their squares, and their products with the residual and with each column.
struct KinkSums {
  double square = 0.0, with_residual = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1> dots;
};

/// N columns, known to the compiler: most of a detection is spent in this loop.
template <int N>
KinkSums kink_sums(ShapeWalk walk, std::span<const double> residual, const double* row) {
  KinkSums sums;
  Eigen::Matrix<double, N, 1> dots = Eigen::Matrix<double, N, 1>::Zero();
  for (const double r : residual) {
    const double c = walk.next();
    sums.square += c * c;
    sums.with_residual += c * r;
    dots += c * Eigen::Map<const Eigen::Matrix<double, N, 1>>(row);
    row += N;
  }
  sums.dots = dots;
  return sums;
}

constexpr std::array kKinkSums{kink_sums<0>, kink_sums<1>, kink_sums<2>, kink_sums<3>, kink_sums<4>,
                               kink_sums<5>, kink_sums<6>, kink_sums<7>, kink_sums<8>};

}  // namespace

Eigen::MatrixXd polynomial_columns(std::size_t n, int degree) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(n), -1.0, 1.0);
  Eigen::MatrixXd columns(t.size(), degree + 1);
  for (int power = 0; power <= degree; ++power) columns.col(power) = t.array().pow(power);
  return columns;
}

KinkScan::KinkScan(std::span<const double> y, std::size_t first, const Eigen::MatrixXd& columns)
    : first_(first), residual_(y.begin(), y.end()) {
  GAPSCOPE_REQUIRE(columns.rows() == static_cast<Eigen::Index>(y.size()) && columns.rows() > columns.cols() &&
                   columns.cols() <= kMostColumns);
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns * scale.cwiseInverse().asDiagonal());
  basis_ = Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank()));
  Eigen::Map<Eigen::VectorXd> left(residual_.data(), columns.rows());
  for (int pass = 0; pass < 2; ++pass) left -= basis_ * (basis_.transpose() * left);  // exact to round-off
  smooth_sse_ = left.squaredNorm();
}

KinkFit KinkScan::trial(const KinkShape& shape, double time) const {
  const double local = time - static_cast<double>(first_);
  const auto begin = static_cast<std::size_t>(std::max(std::ceil(local), 0.0));
  if (begin >= size()) return {time, shape, 0.0, smooth_sse_};
  const auto columns = static_cast<std::size_t>(basis_.cols());
  const KinkSums sums =
      kKinkSums[columns](ShapeWalk(shape, static_cast<double>(begin) - local),
                         std::span(residual_).subspan(begin), basis_.data() + begin * columns);
  const double left = sums.square - sums.dots.squaredNorm();  // of what the columns cannot imitate
  if (!(left > 1e-9 * sums.square)) return {time, shape, 0.0, smooth_sse_};
  const double amplitude = sums.with_residual / left;
  return {time, shape, amplitude, std::max(smooth_sse_ - amplitude * sums.with_residual, 0.0)};
}

KinkFit KinkScan::best(const KinkShape& shape, double from, double to, double step) const {
  constexpr double kFinestTime = 0.1;  // samples
  return least_sse([&](double t) { return trial(shape, t); }, from, to, step, kFinestTime);
}

}  // namespace gapscope::internal::sliding_mode
