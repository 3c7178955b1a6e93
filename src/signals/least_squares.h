#pragma once

#include <Eigen/Core>

namespace gapscope::internal::signals {

/// Least squares of A·x = y, A with at least as many rows as columns; a column that the others make up gets
/// zero. In one place: a compiler takes longer over a decomposition than over all else here.
Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);

/// The same with every coefficient from column `first` on at most zero: of all subsets of these columns, the
/// best whose solution is of that kind. For a handful of columns.
Eigen::VectorXd least_squares_at_most_zero(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                           Eigen::Index first, Eigen::Index count);

/// The upper triangle R with RᵀR = AᵀA: all that least squares of A's columns need of its rows.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

}  // namespace gapscope::internal::signals
