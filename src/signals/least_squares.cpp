#include "signals/least_squares.h"

#include <Eigen/QR>
#include <limits>

namespace gapscope::internal::signals {

Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  const Eigen::VectorXd scale = A.colwise().norm().transpose().cwiseMax(1e-300);
  const Eigen::VectorXd solution = (A * scale.cwiseInverse().asDiagonal()).colPivHouseholderQr().solve(y);
  return solution.cwiseQuotient(scale);
}

Eigen::VectorXd least_squares_at_most_zero(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                           Eigen::Index first, Eigen::Index count) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(A.cols());
  double least = std::numeric_limits<double>::infinity();
  for (unsigned dropped = 0; dropped < 1u << count; ++dropped) {
    Eigen::MatrixXd some = A;
    for (Eigen::Index c = 0; c < count; ++c)
      if (dropped >> c & 1u) some.col(first + c).setZero();
    const Eigen::VectorXd solution = least_squares_of(some, y);
    const double left = (some * solution - y).squaredNorm();
    if (!(solution.segment(first, count).array() <= 0.0).all() || !(left < least)) continue;
    best = solution, least = left;
    if (dropped == 0) break;
  }
  return best;
}

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

}  // namespace gapscope::internal::signals
