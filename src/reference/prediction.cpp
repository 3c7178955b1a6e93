#include "reference/prediction.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::reference {
namespace {

/// Of JᵀJ, over the directions that are determined.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& normal, double max_condition) {
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * normal *
                                                             scale.asDiagonal());
  const double least = eigen.eigenvalues().maxCoeff() / max_condition;
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([&](double e) { return e > least ? 1.0 / e : 0.0; });
  const Eigen::MatrixXd v = scale.asDiagonal() * eigen.eigenvectors();
  return v * inverse.asDiagonal() * v.transpose();
}

}  // namespace

Covariances covariances_at(const FitProblem& fitted, const FitPoint& at, double observer_hz) {
  const auto shared = static_cast<Eigen::Index>(fitted.free_count());
  const Information info = information_at(fitted, at, observer_hz);
  if (!info.valid) return {};
  const Eigen::MatrixXd inverse = inverse_of(info.normal, fitted.options.max_condition);
  const double windows = std::max(2, info.window_count);
  return {info.variance * info.inflation * inverse.topLeftCorner(shared, shared),
          windows / (windows - 1.0) * (inverse * info.windows * inverse).topLeftCorner(shared, shared)};
}

double prediction_std(const FitProblem& fitted, const FitPoint& at, std::span<const LinearResiduals> there,
                      double observer_hz) {
  if (there.empty()) return kNaN;
  if (fitted.free_count() == 0) return 0.0;
  const Covariances of = covariances_at(fitted, at, observer_hz);
  if (of.white.size() == 0) return kNaN;
  double sum = 0.0, samples = 0.0;
  for (const LinearResiduals& r : there) {
    const Eigen::MatrixXd& j = r.derivatives;
    const Eigen::ArrayXd by_white = (j * of.white).cwiseProduct(j).rowwise().sum().array();
    const Eigen::ArrayXd by_scatter = (j * of.scatter).cwiseProduct(j).rowwise().sum().array();
    sum += by_white.max(by_scatter).sum(), samples += static_cast<double>(j.rows());
  }
  return std::sqrt(sum / samples);
}

}  // namespace gapscope::internal::reference
