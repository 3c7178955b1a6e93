#pragma once

#include <optional>

#include "torque_view/screening.h"

namespace gapscope::internal::torque_view {

/// A law's columns g at one shape, on top of a model N whose coefficients are fitted anew with it:
///   of the fitted rows   (I − N N⁺) g,
///   of the held-out ones g − N N⁺ g(fitted): what they show of it after the model has taken its part.
/// A law that adds to another one, which the model lacks, brings that one's columns along, first.
struct Signature {
  const Law* law = nullptr;
  Shape shape;
  Eigen::Index own = 0;                ///< the law's own first column
  Eigen::MatrixXd whole, judge_whole;  ///< g of both
  Eigen::MatrixXd fit, judge;          ///< what is left of them, see above
  Eigen::MatrixXd basis;               ///< orthonormal, of `fit`
  Eigen::MatrixXd coefficients;        ///< of the columns, per unit of the basis
};

/// A fitted model that laws are added to.
class Below {
 public:
  /// The bench must outlive it.
  Below(Bench& bench, const Model& model);

  Signature signature(const Law& law, const Shape& shape);
  /// Every law that a rung could add, at the shapes of its grid, at a few of a long one.
  std::vector<Signature> all_signatures(const TorqueViewOptions& options);

  const Eigen::VectorXd& fit_left() const { return fit_left_; }      ///< of the fitted rows
  const Eigen::VectorXd& judge_left() const { return judge_left_; }  ///< of the held-out ones

 private:
  Eigen::MatrixXd columns(Rows& rows, const Law& law, const Shape& shape, bool with_simpler);

  Bench& bench_;
  const Model& model_;
  Eigen::MatrixXd fit_columns_, judge_columns_;
  Eigen::VectorXd fit_left_, judge_left_, norm_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

}  // namespace gapscope::internal::torque_view
