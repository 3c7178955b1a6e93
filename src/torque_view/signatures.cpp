#include "torque_view/signatures.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::torque_view {
namespace {

constexpr double kSameColumn = 1e-9;  ///< of a square: what is left of it is rounding
constexpr std::size_t kFewShapes =
    9;  ///< at which a law of a long grid is looked at, evenly in its logarithm

/// Some shapes of a long grid, all of a short one.
std::vector<double> few_shapes(const Law& law, const Scales& scales) {
  const std::vector<double> grid = law.shapes(scales);
  if (grid.size() <= kFewShapes) return grid;
  std::vector<double> few;
  const double ratio = grid.back() / grid.front();
  for (std::size_t i = 0; i < kFewShapes; ++i) {
    const double at =
        grid.front() * std::pow(ratio, static_cast<double>(i) / static_cast<double>(kFewShapes - 1));
    const auto next = std::lower_bound(grid.begin(), grid.end(), at);
    few.push_back(next == grid.end() ? grid.back() : *next);
  }
  few.erase(std::unique(few.begin(), few.end()), few.end());
  return few;
}

/// Directions of the columns that are there, as a basis and the coefficients that make it.
void take_basis(Signature& s) {
  const Eigen::VectorXd scale = s.whole.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = s.fit * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([](double e) { return e > kSameColumn ? 1.0 / std::sqrt(e) : 0.0; });
  s.coefficients = scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal();
  s.basis = s.fit * s.coefficients;
}

}  // namespace

Below::Below(Bench& bench, const Model& model)
    : bench_(bench),
      model_(model),
      fit_left_(residual(bench.fit, model, false)),
      judge_left_(bench.left(model)) {
  fit_columns_ = model_columns(bench.fit, model);
  judge_columns_ = model_columns(bench.judge, model);
  norm_ = fit_columns_.colwise().norm().transpose().cwiseMax(1e-300);
  solver_.setThreshold(kSameColumn);
  solver_.compute(fit_columns_ * norm_.cwiseInverse().asDiagonal());
}

Eigen::MatrixXd Below::columns(Rows& rows, const Law& l, const Shape& shape, bool with_simpler) {
  Model added;
  if (with_simpler) added.push_back({&law(l.simpler), kNaN, {}});
  added.push_back({&l, shape, {}});
  return model_columns(rows, added);
}

Signature Below::signature(const Law& l, const Shape& shape) {
  const bool brings = lacks_simpler(model_, l);
  Signature s;
  s.law = &l, s.shape = shape;
  s.whole = columns(bench_.fit, l, shape, brings);
  s.judge_whole = columns(bench_.judge, l, shape, brings);
  s.own = s.whole.cols() - l.columns;
  const Eigen::MatrixXd taken = norm_.cwiseInverse().asDiagonal() * solver_.solve(s.whole);
  s.fit = s.whole - fit_columns_ * taken;
  s.judge = s.judge_whole - judge_columns_ * taken;
  take_basis(s);
  return s;
}

std::vector<Signature> Below::all_signatures(const TorqueViewOptions& options) {
  const std::vector<const Law*> open = open_laws(bench_, model_, options);
  set_torque(bench_.fit, model_), set_torque(bench_.judge, model_);
  std::vector<Signature> all;
  for (const Law* l : open)
    for (const double shape : few_shapes(*l, bench_.scales)) all.push_back(signature(*l, shape));
  return all;
}

}  // namespace gapscope::internal::torque_view
