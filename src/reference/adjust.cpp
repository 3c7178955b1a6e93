#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {
namespace {

using Vector = Cost::Vector;

constexpr double kBorrowedDamping = 0.01;  ///< of derivatives that were taken elsewhere
constexpr double kWorthwhile = 0.97;       ///< of the cost: below it a further step is made

/// Gauss–Newton of the first numbers with borrowed derivatives.
class Adjustment {
 public:
  Adjustment(const FitProblem& problem, const FitPoint& from, std::span<const LinearResiduals> borrowed,
             double hz)
      : cost_(problem, from, hz),
        borrowed_(borrowed),
        moving_(borrowed.front().derivatives.cols()),
        low_(cost_.low()),
        high_(cost_.high()) {
    normal_ = Eigen::MatrixXd::Zero(moving_, moving_);
    for (const LinearResiduals& l : borrowed) normal_ += l.derivatives.transpose() * l.derivatives;
    normal_.diagonal() *= 1.0 + kBorrowedDamping;
  }

  AdjustedFit run(const FitPoint& from, int steps) {
    Vector best = cost_.pack(from);
    double least = evaluate(best);
    for (int i = 0; i < steps && least < kInfinity && moving_ > 0; ++i) {
      stop_point();
      Vector next = best;
      const Vector dq = normal_.ldlt().solve(-gradient_);
      if (!dq.allFinite()) break;  // the derivatives leave a number open
      for (Eigen::Index k = 0; k < moving_; ++k) next[k] = std::clamp(next[k] + dq[k], low_[k], high_[k]);
      const double square = evaluate(next);
      if (!(square < kWorthwhile * least)) break;
      best = next, least = square;
    }
    return {cost_.unpack(best), least, simulations_};
  }

 private:
  double evaluate(const Vector& x) {
    gradient_ = Vector::Zero(moving_);
    double sum = 0.0, count = 0.0;
    for (std::size_t r = 0; r < cost_.recordings(); ++r) {
      Vector residuals(cost_.samples(r));
      const Evaluation done = cost_.evaluate(r, x, residuals.data(), nullptr);
      simulations_ += done.simulations;
      if (!done.valid) return kInfinity;
      gradient_ += borrowed_[r].derivatives.transpose() * residuals;
      sum += residuals.squaredNorm();
      count += static_cast<double>(residuals.size());
    }
    return std::isfinite(sum) ? sum / count : kInfinity;
  }

  Cost cost_;
  std::span<const LinearResiduals> borrowed_;
  Eigen::Index moving_;
  Vector low_, high_, gradient_;
  Eigen::MatrixXd normal_;
  double simulations_ = 0.0;
};

}  // namespace

std::vector<LinearResiduals> linearise(const FitProblem& problem, const FitPoint& at, double hz) {
  const Cost cost(problem, at, hz);
  const Vector x = cost.pack(at);
  std::vector<LinearResiduals> all;
  for (std::size_t r = 0; r < cost.recordings(); ++r) {
    LinearResiduals here{Vector(cost.samples(r)), {}};
    Cost::Rows derivatives(cost.samples(r), cost.shared() + cost.states(r));
    if (!cost.evaluate(r, x, here.residuals.data(), derivatives.data()).valid) return {};
    here.derivatives = derivatives.leftCols(cost.shared());
    all.push_back(std::move(here));
  }
  return all;
}

AdjustedFit adjust(const FitProblem& problem, const FitPoint& from, std::span<const LinearResiduals> borrowed,
                   double hz, int steps) {
  return Adjustment(problem, from, borrowed, hz).run(from, steps);
}

std::optional<SineStart> sine_start(const FitProblem& problem, const FitPoint& at,
                                    std::span<const LinearResiduals> borrowed, double small, double hz) {
  const Cost cost(problem, at, hz);
  Vector x = cost.pack(at);
  const Eigen::Index amplitude = cost.shared() - 2, phase = cost.shared() - 1;
  const auto solver_units = [&](Eigen::Index i, double value) {
    return problem.free_parameter(static_cast<std::size_t>(i)).coordinate.solver(value);
  };
  const Eigen::Index shared = borrowed.front().derivatives.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(shared + 2, shared + 2);
  Vector gradient = Vector::Zero(shared + 2);
  for (std::size_t r = 0; r < cost.recordings(); ++r) {
    Eigen::MatrixXd columns(borrowed[r].residuals.size(), shared + 2);
    columns.leftCols(shared) = borrowed[r].derivatives;
    for (const Eigen::Index quarter : {0, 1}) {
      x[amplitude] = solver_units(amplitude, small);
      x[phase] = solver_units(phase, 0.5 * kPi * double(quarter));
      Vector with(cost.samples(r));
      if (!cost.evaluate(r, x, with.data(), nullptr).valid) return {};
      columns.col(shared + quarter) = (with - borrowed[r].residuals) / small;
    }
    normal += columns.transpose() * columns;
    gradient += columns.transpose() * borrowed[r].residuals;
  }
  normal.diagonal() *= 1.0 + 1e-9;
  const Vector step = normal.ldlt().solve(-gradient);
  if (!step.allFinite()) return {};
  return SineStart{std::hypot(step[shared], step[shared + 1]), std::atan2(step[shared + 1], step[shared])};
}

}  // namespace gapscope::internal::reference
