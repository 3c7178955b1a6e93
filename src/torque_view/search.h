#pragma once

#include "torque_view/model.h"

namespace gapscope::internal::torque_view {

/// Of a law and the one that it adds to.
constexpr int kMostColumns = 16;
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostColumns, 1>;

/// What a model's columns leave of a signal y (the input, if none is given) and of other columns:
/// (I − P) y, (I − P) g.
class Projection {
 public:
  Projection(Rows& rows, const Model& model);
  Projection(Rows& rows, const Model& model, const Eigen::VectorXd& y);
  const Eigen::VectorXd& left() const { return left_; }
  double square() const { return square_; }

  /// What columns (at most kMostColumns) gain when they are fitted jointly with the model, as a share of
  /// what it leaves, and their coefficients. Does not allocate.
  struct Gain {
    double share = 0.0;
    Coefficients theta;
  };
  Gain gain(const Eigen::Ref<const Eigen::MatrixXd>& columns);
  /// What then is left of the signal.
  Eigen::VectorXd left_after(const Eigen::Ref<const Eigen::MatrixXd>& columns);

 private:
  Eigen::MatrixXd basis_, along_;
  Eigen::VectorXd left_;
  double square_ = 0.0;
};

/// Whether the law's own coefficient is one that its physics allows.
bool has_its_sign(const Law& law, double theta, double inertia);

/// The shape at which a law gains most, beside what the model has; NaN gain if it is absent at every one.
struct BestShape {
  Shape shape;
  double gain = kNaN;
};
BestShape best_shape(Rows& rows, Projection& projection, const Law& law, const Scales& scales);

}  // namespace gapscope::internal::torque_view
