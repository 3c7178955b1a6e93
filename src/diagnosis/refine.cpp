#include "diagnosis/refine.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "gapscope/base/interrupt.h"
#include "reference/recording_cost.h"

namespace gapscope::internal::diagnosis {
namespace {

using Vector = Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kSecantSteps = 5;         ///< of Broyden between two exact derivatives
constexpr double kTrusted = 0.5;        ///< share of the foretold decrease that leaves the derivatives alone
constexpr double kFirstDamping = 1e-3;  ///< Marquardt's λ
constexpr double kMostDamping = 1e8;

/// One recording: its residuals and their derivatives by the shared numbers and its own initial ones.
struct Block {
  std::unique_ptr<reference::RecordingCost> cost;
  Eigen::Index first_state = 0;  ///< place of its own numbers in the whole vector
  Eigen::Index states = 0;
  Vector residuals;
  Rows derivatives;  // (samples × (shared + states))
};

class Descent {
 public:
  Descent(const reference::FitProblem& problem, const reference::Solution& from, double hz)
      : problem_(problem), from_(from) {
    shared_ = static_cast<Eigen::Index>(problem.free_count());
    std::vector<double> x = from.q;
    for (std::size_t r = 0; r < from.starts.size(); ++r) {
      Block block;
      block.cost = std::make_unique<reference::RecordingCost>(problem, r, from.starts[r], hz);
      block.first_state = static_cast<Eigen::Index>(x.size());
      block.states = static_cast<Eigen::Index>(block.cost->states().size());
      for (const int s : block.cost->states()) x.push_back(from.starts[r].q[static_cast<std::size_t>(s)]);
      const auto samples = static_cast<Eigen::Index>(problem.recordings[r].size());
      block.residuals.resize(samples);
      block.derivatives.resize(samples, shared_ + block.states);
      count_ += static_cast<double>(samples);
      blocks_.push_back(std::move(block));
    }
    x_ = Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
    set_bounds();
  }

  reference::Solution run(const Work& work) {
    reference::Solution to = from_;
    to.mean_square = kInfinity;
    to.converged = false;
    if (!differentiate()) return to;
    to.converged = descend(work);
    read_back(to);
    to.mean_square = cost_ / count_;
    return to;
  }

 private:
  void set_bounds() {
    low_ = Vector::Constant(x_.size(), -kInfinity);
    high_ = Vector::Constant(x_.size(), kInfinity);
    for (Eigen::Index i = 0; i < shared_; ++i) {
      const reference::Parameter& p = problem_.free_parameter(static_cast<std::size_t>(i));
      low_[i] = p.coordinate.solver(p.low), high_[i] = p.coordinate.solver(p.high);
    }
    x_ = x_.cwiseMax(low_).cwiseMin(high_);
  }

  Vector own(const Block& b, const Vector& x) const {
    Vector q(shared_ + b.states);
    q << x.head(shared_), x.segment(b.first_state, b.states);
    return q;
  }

  /// Residual of what is known beforehand of a shared number; 0 where nothing is.
  double prior_residual(Eigen::Index i, double q) const {
    const reference::Parameter& p = problem_.free_parameter(static_cast<std::size_t>(i));
    return p.prior ? (p.coordinate.physical(q) - p.prior->value) / p.prior->std : 0.0;
  }
  double prior_slope(Eigen::Index i, double q) const {
    const reference::Parameter& p = problem_.free_parameter(static_cast<std::size_t>(i));
    return p.prior ? p.coordinate.slope(q) / p.prior->std : 0.0;
  }

  double beside(const Vector& x) const {
    double sum = x.tail(x.size() - shared_).squaredNorm() / (reference::kStateWidth * reference::kStateWidth);
    for (Eigen::Index i = 0; i < shared_; ++i) sum += std::pow(prior_residual(i, x[i]), 2);
    return sum;
  }

  bool differentiate() {
    double sum = beside(x_);
    for (Block& b : blocks_) {
      const Vector q = own(b, x_);
      if (!b.cost->evaluate(q.data(), b.residuals.data(), b.derivatives.data())) return false;
      sum += b.residuals.squaredNorm();
    }
    cost_ = sum;
    set_normal();
    fresh_ = true;
    secants_ = 0;
    return std::isfinite(cost_);
  }

  void set_normal() {
    normal_ = Eigen::MatrixXd::Zero(x_.size(), x_.size());
    gradient_ = Vector::Zero(x_.size());
    for (const Block& b : blocks_) {
      const Eigen::MatrixXd square = b.derivatives.transpose() * b.derivatives;
      const Vector slope = b.derivatives.transpose() * b.residuals;
      const Eigen::Index f = b.first_state;
      normal_.topLeftCorner(shared_, shared_) += square.topLeftCorner(shared_, shared_);
      normal_.block(0, f, shared_, b.states) += square.topRightCorner(shared_, b.states);
      normal_.block(f, 0, b.states, shared_) += square.bottomLeftCorner(b.states, shared_);
      normal_.block(f, f, b.states, b.states) += square.bottomRightCorner(b.states, b.states);
      gradient_.head(shared_) += slope.head(shared_);
      gradient_.segment(f, b.states) += slope.tail(b.states);
    }
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const double slope = i < shared_ ? prior_slope(i, x_[i]) : 1.0 / reference::kStateWidth;
      const double residual = i < shared_ ? prior_residual(i, x_[i]) : x_[i] / reference::kStateWidth;
      normal_(i, i) += slope * slope;
      gradient_[i] += slope * residual;
    }
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
    double sum = beside(next);
    for (Block& b : blocks_) {
      Vector r(b.residuals.size());
      const Vector q = own(b, next);
      if (!b.cost->evaluate(q.data(), r.data(), nullptr)) return -1.0;
      sum += r.squaredNorm();
      trial.push_back(std::move(r));
    }
    if (!std::isfinite(sum)) return -1.0;
    const double foretold = -(2.0 * gradient_.dot(dx) + dx.dot(normal_ * dx));
    agreement_ = foretold > 0.0 ? (cost_ - sum) / foretold : 0.0;
    if (sum >= cost_) return -1.0;
    follow(dx, trial);
    const double decrease = (cost_ - sum) / cost_;
    x_ = next, cost_ = sum;
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
      const Vector d = own(b, dx);
      const double square = d.squaredNorm();
      if (square <= 0.0) continue;
      const Vector missed = trial[i] - b.residuals - b.derivatives * d;
      b.derivatives.noalias() += missed * (d.transpose() / square);
    }
  }

  bool descend(const Work& work) {
    int jacobians = 1;
    const auto renew = [&] {
      if (jacobians >= work.jacobians) return false;
      ++jacobians;
      return differentiate();
    };
    for (int trial = 0; trial < work.trials; ++trial) {
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
      const bool stalled = decrease < work.tolerance;
      if (stalled && was_fresh) return true;
      if ((stalled || agreement_ < kTrusted || secants_ >= kSecantSteps) && !renew() && stalled) return true;
    }
    return false;
  }

  void read_back(reference::Solution& to) const {
    for (Eigen::Index i = 0; i < shared_; ++i) to.q[static_cast<std::size_t>(i)] = x_[i];
    for (std::size_t r = 0; r < blocks_.size(); ++r) {
      const std::vector<int>& states = blocks_[r].cost->states();
      for (std::size_t i = 0; i < states.size(); ++i)
        to.starts[r].q[static_cast<std::size_t>(states[i])] =
            x_[blocks_[r].first_state + static_cast<Eigen::Index>(i)];
    }
  }

  const reference::FitProblem& problem_;
  const reference::Solution& from_;
  std::vector<Block> blocks_;
  Eigen::Index shared_ = 0;
  Vector x_, low_, high_, gradient_;
  Eigen::MatrixXd normal_;
  double cost_ = kInfinity, count_ = 0.0, damping_ = kFirstDamping, agreement_ = 0.0;
  bool fresh_ = false;
  int secants_ = 0;
};

}  // namespace

reference::Solution refine(const reference::FitProblem& problem, const reference::Solution& from,
                           double observer_hz, const Work& work) {
  return Descent(problem, from, observer_hz).run(work);
}

}  // namespace gapscope::internal::diagnosis
