#pragma once

#include <Eigen/Core>

namespace gapscope::internal::sliding_mode {

/// Least squares of A·x = y, A with at least as many rows as columns; a column that the others make up gets
/// zero. In one place but for what is called for every trial (pooled_flights.cpp, kink_fit.cpp): a compiler
/// takes longer over a decomposition than over all else here.
Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);

/// The upper triangle R with RᵀR = AᵀA: all that least squares of A's columns need of its rows.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

}  // namespace gapscope::internal::sliding_mode
