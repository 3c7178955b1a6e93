#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {
namespace {

using Vector = Cost::Vector;

constexpr int kSecantSteps = 5;         ///< of Broyden between two exact derivatives
constexpr double kTrusted = 0.5;        ///< share of the foretold decrease that leaves the derivatives alone
constexpr double kFirstDamping = 1e-3;  ///< Marquardt's λ
constexpr double kMostDamping = 1e8;

/// One recording: its residuals and their derivatives by the shared numbers and its own initial ones.
struct Block {
  Vector residuals;
  Cost::Rows derivatives;  // (samples × (shared + states))
};

class Descent {
 public:
  Descent(const FitProblem& problem, const FitPoint& from, double hz)
      : cost_(problem, from, hz), low_(cost_.low()), high_(cost_.high()) {
    x_ = cost_.pack(from).cwiseMax(low_).cwiseMin(high_);
    for (std::size_t r = 0; r < cost_.recordings(); ++r)
      blocks_.push_back(
          {Vector(cost_.samples(r)), Cost::Rows(cost_.samples(r), cost_.shared() + cost_.states(r))});
  }

  RefinedFit run(const FitPoint& from, const RefineEffort& effort) {
    RefinedFit to{from};
    if (differentiate()) {
      to.converged = descend(effort);
      static_cast<FitPoint&>(to) = cost_.unpack(x_);
      to.mean_cost = value_ / cost_.all_samples();
    }
    to.simulations = simulations_;
    return to;
  }

 private:
  /// @returns whether the motion stayed within the numbers
  bool evaluate(std::size_t r, const Vector& x, Vector& residuals, double* derivatives) {
    const Evaluation done = cost_.evaluate(r, x, residuals.data(), derivatives);
    simulations_ += done.simulations;
    return done.valid;
  }

  bool differentiate() {
    double sum = cost_.beside(x_);
    for (std::size_t r = 0; r < blocks_.size(); ++r) {
      Block& b = blocks_[r];
      if (!evaluate(r, x_, b.residuals, b.derivatives.data())) return false;
      sum += b.residuals.squaredNorm();
    }
    value_ = sum;
    set_normal();
    fresh_ = true;
    secants_ = 0;
    return std::isfinite(value_);
  }

  void set_normal() {
    normal_ = Eigen::MatrixXd::Zero(x_.size(), x_.size());
    gradient_ = Vector::Zero(x_.size());
    for (std::size_t r = 0; r < blocks_.size(); ++r) add_to_normal(r);
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const double slope = cost_.beside_slope(i, x_[i]);
      normal_(i, i) += slope * slope;
      gradient_[i] += slope * cost_.beside_residual(i, x_[i]);
    }
  }

  void add_to_normal(std::size_t r) {
    const Block& b = blocks_[r];
    const Eigen::MatrixXd square = b.derivatives.transpose() * b.derivatives;
    const Vector slope = b.derivatives.transpose() * b.residuals;
    const Eigen::Index f = cost_.first_state(r), shared = cost_.shared(), states = cost_.states(r);
    normal_.topLeftCorner(shared, shared) += square.topLeftCorner(shared, shared);
    normal_.block(0, f, shared, states) += square.topRightCorner(shared, states);
    normal_.block(f, 0, states, shared) += square.bottomLeftCorner(states, shared);
    normal_.block(f, f, states, states) += square.bottomRightCorner(states, states);
    gradient_.head(shared) += slope.head(shared);
    gradient_.segment(f, states) += slope.tail(states);
  }

  /// The damped step within the bounds: numbers that a bound holds back stay.
  Vector step() const {
    std::vector<Eigen::Index> moving;
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const bool held = (x_[i] <= low_[i] && gradient_[i] > 0.0) || (x_[i] >= high_[i] && gradient_[i] < 0.0);
      if (!held && normal_(i, i) > 0.0) moving.push_back(i);
    }
    Eigen::MatrixXd a = normal_(moving, moving);
    a.diagonal() *= 1.0 + damping_;
    const Vector part = a.ldlt().solve(-gradient_(moving));
    Vector whole = Vector::Zero(x_.size());
    whole(moving) = part;
    return ((x_ + whole).cwiseMax(low_).cwiseMin(high_) - x_).eval();
  }

  /// One trial. @returns the relative decrease; negative: refused.
  double attempt() {
    const Vector dx = step();
    if (!dx.allFinite()) return -1.0;
    const Vector next = x_ + dx;
    std::vector<Vector> trial;
    double sum = cost_.beside(next);
    for (std::size_t r = 0; r < blocks_.size(); ++r) {
      Vector residuals(cost_.samples(r));
      if (!evaluate(r, next, residuals, nullptr)) return -1.0;
      sum += residuals.squaredNorm();
      trial.push_back(std::move(residuals));
    }
    if (!std::isfinite(sum)) return -1.0;
    const double foretold = -(2.0 * gradient_.dot(dx) + dx.dot(normal_ * dx));
    agreement_ = foretold > 0.0 ? (value_ - sum) / foretold : 0.0;
    if (sum >= value_) return -1.0;
    follow(dx, trial);
    const double decrease = (value_ - sum) / value_;
    x_ = next, value_ = sum;
    for (std::size_t i = 0; i < blocks_.size(); ++i) blocks_[i].residuals = trial[i];
    set_normal();
    return decrease;
  }

  /// Broyden: the least change of the derivatives that explains the last difference of residuals.
  void follow(const Vector& dx, const std::vector<Vector>& trial) {
    fresh_ = false;
    ++secants_;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      Block& b = blocks_[i];
      const Vector d = cost_.own(i, dx);
      const double square = d.squaredNorm();
      if (square <= 0.0) continue;
      const Vector missed = trial[i] - b.residuals - b.derivatives * d;
      b.derivatives.noalias() += missed * (d.transpose() / square);
    }
  }

  bool descend(const RefineEffort& effort) {
    int jacobians = 1;
    const auto renew = [&] {
      if (jacobians >= effort.jacobians) return false;
      ++jacobians;
      return differentiate();
    };
    for (int trial = 0; trial < effort.trials; ++trial) {
      stop_point();
      const bool was_fresh = fresh_;
      const double decrease = attempt();
      if (decrease < 0.0) {
        if (!was_fresh && renew()) continue;
        damping_ = std::max(damping_, 1e-4) * 8.0;
        if (damping_ > kMostDamping) return true;
        continue;
      }
      damping_ *= agreement_ > 0.75 ? 0.1 : agreement_ < 0.25 ? 3.0 : 1.0;
      const bool stalled = decrease < effort.tolerance;
      if (stalled && was_fresh) return true;
      if ((stalled || agreement_ < kTrusted || secants_ >= kSecantSteps) && !renew() && stalled) return true;
    }
    return false;
  }

  Cost cost_;
  std::vector<Block> blocks_;
  Vector x_, low_, high_, gradient_;
  Eigen::MatrixXd normal_;
  double value_ = kInfinity;  ///< of the cost at x
  double damping_ = kFirstDamping, agreement_ = 0.0, simulations_ = 0.0;
  bool fresh_ = false;
  int secants_ = 0;
};

}  // namespace

RefinedFit refine(const FitProblem& problem, const FitPoint& from, double observer_hz,
                  const RefineEffort& effort) {
  return Descent(problem, from, observer_hz).run(from, effort);
}

}  // namespace gapscope::internal::reference
