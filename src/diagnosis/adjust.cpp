#include "diagnosis/adjust.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/interrupt.h"
#include "reference/recording_cost.h"

namespace gapscope::internal::diagnosis {
namespace {

using Vector = Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kBorrowedDamping = 0.01;  ///< of derivatives that were taken elsewhere
constexpr double kWorthwhile = 0.97;       ///< of the cost: below it a further step is made

/// Residuals of one recording at a point; empty if the motion diverges.
Vector residuals_at(const reference::FitProblem& problem, const reference::Solution& at, std::size_t r,
                    double hz) {
  const reference::RecordingCost cost(problem, r, at.starts[r], hz);
  std::vector<double> q = at.q;
  for (const int s : cost.states()) q.push_back(at.starts[r].q[static_cast<std::size_t>(s)]);
  Vector residuals(static_cast<Eigen::Index>(problem.recordings[r].size()));
  return cost.evaluate(q.data(), residuals.data(), nullptr) ? residuals : Vector();
}

/// Gauss–Newton of the first numbers with borrowed derivatives.
class Adjustment {
 public:
  Adjustment(const reference::FitProblem& problem, std::span<const Linear> borrowed, double hz)
      : problem_(problem), borrowed_(borrowed), hz_(hz), moving_(borrowed.front().derivatives.cols()) {
    normal_ = Eigen::MatrixXd::Zero(moving_, moving_);
    for (const Linear& l : borrowed) normal_ += l.derivatives.transpose() * l.derivatives;
    normal_.diagonal() *= 1.0 + kBorrowedDamping;
  }

  reference::Solution run(const reference::Solution& from, int steps) {
    reference::Solution best = from;
    best.mean_square = evaluate(from);
    if (!best.usable() || moving_ == 0) return best;
    for (int i = 0; i < steps; ++i) {
      stop_point();
      reference::Solution next = best;
      const Vector dq = normal_.ldlt().solve(-gradient_);
      for (Eigen::Index k = 0; k < moving_; ++k) move(next.q[static_cast<std::size_t>(k)], k, dq[k]);
      next.mean_square = evaluate(next);
      if (!(next.mean_square < kWorthwhile * best.mean_square)) break;
      best = next;
    }
    return best;
  }

 private:
  void move(double& q, Eigen::Index k, double step) const {
    const reference::Parameter& p = problem_.free_parameter(static_cast<std::size_t>(k));
    q = std::clamp(q + step, p.coordinate.solver(p.low), p.coordinate.solver(p.high));
  }

  double evaluate(const reference::Solution& at) {
    gradient_ = Vector::Zero(moving_);
    double sum = 0.0, count = 0.0;
    for (std::size_t r = 0; r < at.starts.size(); ++r) {
      const Vector residuals = residuals_at(problem_, at, r, hz_);
      if (residuals.size() == 0) return kInfinity;
      gradient_ += borrowed_[r].derivatives.transpose() * residuals;
      sum += residuals.squaredNorm();
      count += static_cast<double>(residuals.size());
    }
    return std::isfinite(sum) ? sum / count : kInfinity;
  }

  const reference::FitProblem& problem_;
  std::span<const Linear> borrowed_;
  double hz_;
  Eigen::Index moving_;
  Eigen::MatrixXd normal_;
  Vector gradient_;
};

}  // namespace

std::vector<Linear> linearise(const reference::FitProblem& problem, const reference::Solution& at,
                              double hz) {
  std::vector<Linear> all;
  const auto shared = static_cast<Eigen::Index>(problem.free_count());
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    const reference::RecordingCost cost(problem, r, at.starts[r], hz);
    std::vector<double> q = at.q;
    for (const int s : cost.states()) q.push_back(at.starts[r].q[static_cast<std::size_t>(s)]);
    const auto samples = static_cast<Eigen::Index>(problem.recordings[r].size());
    Linear here{Vector(samples), {}};
    Rows derivatives(samples, static_cast<Eigen::Index>(q.size()));
    if (!cost.evaluate(q.data(), here.residuals.data(), derivatives.data())) return {};
    here.derivatives = derivatives.leftCols(shared);
    all.push_back(std::move(here));
  }
  return all;
}

reference::Solution adjust(const reference::FitProblem& problem, const reference::Solution& from,
                           std::span<const Linear> borrowed, double hz, int steps) {
  return Adjustment(problem, borrowed, hz).run(from, steps);
}

std::optional<SineStart> sine_start(const reference::FitProblem& problem, const reference::Solution& at,
                                    std::span<const Linear> borrowed, double small, double hz) {
  const std::size_t amplitude = at.q.size() - 2, phase = at.q.size() - 1;
  const Eigen::Index shared = borrowed.front().derivatives.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(shared + 2, shared + 2);
  Vector gradient = Vector::Zero(shared + 2);
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    Eigen::MatrixXd columns(borrowed[r].residuals.size(), shared + 2);
    columns.leftCols(shared) = borrowed[r].derivatives;
    for (const Eigen::Index quarter : {0, 1}) {
      reference::Solution point = at;
      point.q[amplitude] = problem.free_parameter(amplitude).coordinate.solver(small);
      point.q[phase] = problem.free_parameter(phase).coordinate.solver(0.5 * kPi * double(quarter));
      const Vector with = residuals_at(problem, point, r, hz);
      if (with.size() == 0) return {};
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

}  // namespace gapscope::internal::diagnosis
