#include "torque_view/search.h"

#include <algorithm>
#include <cmath>

#include "torque_view/spring_search.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr double kSaidAlready = 1e-6;  ///< of a column's square: what is left of it is rounding
constexpr int kRefinements = 7;        ///< of a line, within ± half a cell

constexpr double kRidge = 1e-10;  ///< of columns that say the same

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostColumns, kMostColumns>;

/// sin kx and cos kx at the samples, turned on from k to k + Δk by four multiplications.
class TurningLine {
 public:
  TurningLine(const Rows& rows, double k, double step) {
    for (const BandRecord& r : rows.records()) {
      now_.push_back(angles(r.x, k));
      step_.push_back(angles(r.x, step));
    }
  }
  void columns(Rows& rows, const Law& law, Eigen::Ref<Eigen::MatrixXd> out) const {
    for (std::size_t r = 0; r < now_.size(); ++r) {
      auto g = rows.at_samples.topLeftCorner(now_[r].rows(), 2);
      g = now_[r];
      if (law.kind == Kind::kOnTorque)
        g.array().colwise() *= Eigen::Map<const Eigen::ArrayXd>(rows.tau[r].data(), now_[r].rows());
      filter_columns(rows, law, r, out);
    }
    centre(rows, out);
  }
  void turn() {
    for (std::size_t r = 0; r < now_.size(); ++r)
      for (Eigen::Index i = 0; i < now_[r].rows(); ++i) {
        const double s = now_[r](i, 0), c = now_[r](i, 1), ds = step_[r](i, 0), dc = step_[r](i, 1);
        now_[r](i, 0) = s * dc + c * ds;
        now_[r](i, 1) = c * dc - s * ds;
      }
  }

 private:
  static Eigen::MatrixX2d angles(const std::vector<double>& x, double k) {
    const Eigen::Map<const Eigen::ArrayXd> at(x.data(), static_cast<Eigen::Index>(x.size()));
    Eigen::MatrixX2d g(at.size(), 2);
    g << (k * at).sin(), (k * at).cos();
    return g;
  }
  std::vector<Eigen::MatrixX2d> now_, step_;
};

BestShape refined_line(Rows& rows, Projection& projection, const Law& law, double centre_k, double cell) {
  BestShape best;
  Eigen::MatrixXd columns(rows.size(), 2);
  for (int i = 0; i < kRefinements; ++i) {
    const double k = centre_k + cell * (static_cast<double>(i) / (kRefinements - 1) - 0.5);
    fill_columns(rows, law, k, columns);
    const double gain = projection.gain(columns).share;
    if (!(gain <= best.gain)) best = {k, gain};
  }
  return best;
}

BestShape best_line(Rows& rows, Projection& projection, const Law& law, const std::vector<double>& grid,
                    std::span<const double> beside) {
  if (grid.size() < 2) return {};
  const double cell = grid[1] - grid[0];
  TurningLine line(rows, grid.front(), cell);
  Eigen::MatrixXd columns(rows.size(), 2);
  BestShape best;
  for (const double k : grid) {
    line.columns(rows, law, columns);
    const double gain = projection.gain(columns).share;
    if (!(gain <= best.gain)) best = {k, gain};
    line.turn();
  }
  BestShape refined = refined_line(rows, projection, law, best.shape, cell);
  for (const double k : beside)
    if (const BestShape there = refined_line(rows, projection, law, k, cell); there.gain > refined.gain)
      refined = there;
  return refined_line(rows, projection, law, refined.shape, cell / (kRefinements - 1));
}

}  // namespace

Projection::Projection(Rows& rows, const Model& model) : Projection(rows, model, rows.u) {}

Projection::Projection(Rows& rows, const Model& model, const Eigen::VectorXd& y) {
  Eigen::MatrixXd columns = model_and_swing(rows, model);
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  columns = columns * norm.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(1e-9);
  basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(rows.size(), qr.rank());
  left_ = y - basis_ * (basis_.transpose() * y);
  square_ = left_.squaredNorm();
  along_.resize(basis_.cols(), kMostColumns);
}

Projection::Gain Projection::gain(const Eigen::Ref<const Eigen::MatrixXd>& g) {
  const Eigen::Index n = g.cols();
  auto along = along_.leftCols(n);
  along.noalias() = basis_.transpose() * g;
  Small gram(n, n);
  Coefficients against(n);
  gram.noalias() = g.transpose() * g;
  const Coefficients before = gram.diagonal();
  gram.noalias() -= along.transpose() * along;  // ‖(I − P) g‖², as P is a projection
  against.noalias() = g.transpose() * left_;    // and left = (I − P) y
  for (Eigen::Index c = 0; c < n; ++c) {
    if (gram(c, c) > kSaidAlready * before[c]) continue;
    gram.row(c).setZero(), gram.col(c).setZero();
    gram(c, c) = 1.0, against[c] = 0.0;
  }
  const Coefficients scale = gram.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  gram.diagonal().array() += kRidge;
  Gain gain;
  gain.theta = scale.cwiseProduct(gram.ldlt().solve(scale.cwiseProduct(against)));
  gain.share = square_ > 0.0 ? gain.theta.dot(against) / square_ : 0.0;
  return gain;
}

Eigen::VectorXd Projection::left_after(const Eigen::Ref<const Eigen::MatrixXd>& g) {
  const Gain gained = gain(g);
  Eigen::VectorXd along = basis_.transpose() * (g * gained.theta);
  return left_ - g * gained.theta + basis_ * along;
}

bool has_its_sign(const Law& law, double theta, double inertia) {
  switch (law.sign) {
    case Sign::kAny:
      return true;
    case Sign::kPositive:
      return theta > 0.0;
    case Sign::kNegative:
      return theta < 0.0;
    case Sign::kShareOfInertia:
      return theta > 0.0 && theta < inertia;
  }
  return false;
}

BestShape best_shape(Rows& rows, Projection& projection, const Law& law, const Scales& scales) {
  const std::vector<double> shapes = law.shapes(scales);
  if (law.shapes == line_grid) return best_line(rows, projection, law, shapes, scales.lines);
  if (law.sign == Sign::kShareOfInertia) return best_spring(rows, projection, law, shapes);
  BestShape best;
  Eigen::MatrixXd columns(rows.size(), law.columns);
  for (const double shape : shapes) {
    fill_columns(rows, law, shape, columns);
    const Projection::Gain gain = projection.gain(columns);
    if (has_its_sign(law, gain.theta[0], kInfinity) && !(gain.share <= best.gain)) best = {shape, gain.share};
  }
  return best;
}

}  // namespace gapscope::internal::torque_view
