#pragma once

#include <Eigen/Core>

namespace gapscope::internal::sliding_mode {

/// Least squares of A·x = y, A with at least as many rows as columns; what a column has of those before it
/// is set aside. In one place, since a compiler takes longer over a decomposition than over all else here.
Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);

/// The upper triangle R with RᵀR = AᵀA: all that least squares of A's columns need of its rows.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

}  // namespace gapscope::internal::sliding_mode
