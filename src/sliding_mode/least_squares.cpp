#include "sliding_mode/least_squares.h"

#include <Eigen/QR>

namespace gapscope::internal::sliding_mode {

Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  return A.colPivHouseholderQr().solve(y);
}

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

}  // namespace gapscope::internal::sliding_mode
