#include "sliding_mode/passage/contact_onset.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "sliding_mode/kink_fit.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kFinestTime = 0.05, kFinestEdge = 1e-7;  ///< samples

/// s and the second integrals of the three parts of the torque.
Eigen::RowVector4d parts(double s) {
  const double s2 = s * s, s3 = s2 * s, s4 = s2 * s2;
  return {s, s2 / 2.0 - s3 / 3.0 + s4 / 12.0, s3 / 3.0 - s4 / 6.0, s4 / 12.0};
}

/// Least squares of a normal equation with no number below zero: the best of all subsets.
/// @returns by how much it lowers the sum of squares
double solve_positive(const Eigen::Matrix4d& G, const Eigen::Vector4d& b, unsigned fixed,
                      Eigen::Vector4d& numbers) {
  double most = 0.0;
  numbers.setZero();
  for (unsigned subset = 1; subset < 16; ++subset) {
    if (subset & fixed) continue;
    int chosen[4], n = 0;
    for (int k = 0; k < 4; ++k)
      if (subset >> k & 1u) chosen[n++] = k;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> part(n, n);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> right(n);
    for (int i = 0; i < n; ++i) {
      right(i) = b(chosen[i]);
      for (int j = 0; j < n; ++j) part(i, j) = G(chosen[i], chosen[j]);
    }
    const Eigen::LDLT<decltype(part)> ldlt(part);
    if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 1e-10 * ldlt.vectorD().maxCoeff()))
      continue;
    const auto x = ldlt.solve(right).eval();
    if (!(x.minCoeff() >= 0.0)) continue;
    const double lowers = right.dot(x);
    if (lowers <= most) continue;
    most = lowers;
    numbers.setZero();
    for (int i = 0; i < n; ++i) numbers(chosen[i]) = x(i);
  }
  return most;
}

}  // namespace

double Onset::operator()(double t) const {
  return t > time ? parts((t - time) / (last - time)).dot(numbers.transpose()) : 0.0;
}

OnsetScan::OnsetScan(const Eigen::VectorXd& y, std::size_t first, int direction,
                     const Eigen::MatrixXd& columns, Start start)
    : first_(first), fixed_(start == Start::kImpact ? 0u : 1u) {
  GAPSCOPE_REQUIRE(columns.rows() == y.size() && columns.rows() > columns.cols() && columns.cols() <= 8);
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns * scale.cwiseInverse().asDiagonal());
  basis_ = Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank()));
  residual_ = -direction * y;
  for (int pass = 0; pass < 2; ++pass)
    residual_ -= basis_ * (basis_.transpose() * residual_);  // to round-off
  smooth_ = residual_.squaredNorm();
}

Onset OnsetScan::trial(double time) const {
  const double local = time - static_cast<double>(first_);
  const Eigen::Index begin = static_cast<Eigen::Index>(std::max(std::floor(local) + 1.0, 0.0));
  Onset onset{time, smooth_, Eigen::Vector4d::Zero(),
              static_cast<double>(first_) + static_cast<double>(residual_.size() - 1)};
  if (begin >= residual_.size()) return onset;
  const double length = static_cast<double>(residual_.size() - 1) - local;
  Eigen::Matrix4d G = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 8, 4> dots = Eigen::MatrixXd::Zero(basis_.cols(), 4);
  for (Eigen::Index i = begin; i < residual_.size(); ++i) {
    const Eigen::RowVector4d row = parts((static_cast<double>(i) - local) / length);
    G += row.transpose() * row;
    b += row.transpose() * residual_(i);
    dots += basis_.row(i).transpose() * row;
  }
  G -= dots.transpose() * dots;
  onset.sse = std::max(smooth_ - solve_positive(G, b, fixed_, onset.numbers), 0.0);
  return onset;
}

Onset OnsetScan::best(double from, double to, double step, double alike) const {
  const Onset least = least_sse([&](double t) { return trial(t); }, from, to, step, kFinestTime);
  const double limit = least.sse + alike;
  const auto edge = [&](double way) {
    double in = least.time, out = in + way;
    for (; out >= from && out <= to && trial(out).sse <= limit; way *= 2.0) in = out, out += way;
    out = std::clamp(out, from, to);
    while (std::abs(out - in) > kFinestEdge) {
      const double middle = 0.5 * (in + out);
      (trial(middle).sse <= limit ? in : out) = middle;
    }
    return in;
  };
  return trial(0.5 * (edge(-kFinestTime) + edge(kFinestTime)));
}

Interval OnsetScan::within(double from, double to, double step, double limit) const {
  double low = kInfinity, high = -kInfinity;
  for (double t = from; t <= to; t += step)
    if (trial(t).sse <= limit) low = std::min(low, t), high = std::max(high, t);
  return {low, high};
}

}  // namespace gapscope::internal::sliding_mode
