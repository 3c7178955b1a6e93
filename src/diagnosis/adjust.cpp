#include "diagnosis/adjust.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/interrupt.h"
#include "reference/recording_cost.h"

namespace gapscope::internal {
namespace {

using Vector = Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kBorrowedDamping = 0.01;  ///< of derivatives that were taken elsewhere
constexpr double kWorthwhile = 0.97;       ///< of the cost: below it a further step is made

/// Gauss–Newton of the first numbers with borrowed derivatives.
class Adjustment {
 public:
  Adjustment(const FitProblem& problem, std::span<const Linear> borrowed, double hz)
      : problem_(problem), borrowed_(borrowed), hz_(hz), moving_(borrowed.front().derivatives.cols()) {
    normal_ = Eigen::MatrixXd::Zero(moving_, moving_);
    for (const Linear& l : borrowed) normal_ += l.derivatives.transpose() * l.derivatives;
    normal_.diagonal() *= 1.0 + kBorrowedDamping;
  }

  Solution run(const Solution& from, int steps) {
    Solution best = from;
    best.mean_square = evaluate(from);
    if (!best.usable() || moving_ == 0) return best;
    for (int i = 0; i < steps; ++i) {
      stop_point();
      Solution next = best;
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
    const Parameter& p = problem_.free_parameter(static_cast<std::size_t>(k));
    q = std::clamp(q + step, p.coordinate.solver(p.low), p.coordinate.solver(p.high));
  }

  double evaluate(const Solution& at) {
    gradient_ = Vector::Zero(moving_);
    double sum = 0.0, count = 0.0;
    for (std::size_t r = 0; r < at.starts.size(); ++r) {
      const RecordingCost cost(problem_, r, at.starts[r], hz_);
      std::vector<double> q = at.q;
      for (const int s : cost.states()) q.push_back(at.starts[r].q[static_cast<std::size_t>(s)]);
      Vector residuals(static_cast<Eigen::Index>(problem_.recordings[r].size()));
      if (!cost.evaluate(q.data(), residuals.data(), nullptr)) return kInfinity;
      gradient_ += borrowed_[r].derivatives.transpose() * residuals;
      sum += residuals.squaredNorm();
      count += static_cast<double>(residuals.size());
    }
    return std::isfinite(sum) ? sum / count : kInfinity;
  }

  const FitProblem& problem_;
  std::span<const Linear> borrowed_;
  double hz_;
  Eigen::Index moving_;
  Eigen::MatrixXd normal_;
  Vector gradient_;
};

}  // namespace

std::vector<Linear> linearise(const FitProblem& problem, const Solution& at, double hz) {
  std::vector<Linear> all;
  const auto shared = static_cast<Eigen::Index>(problem.free_count());
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    const RecordingCost cost(problem, r, at.starts[r], hz);
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

Solution adjust(const FitProblem& problem, const Solution& from, std::span<const Linear> borrowed, double hz,
                int steps) {
  return Adjustment(problem, borrowed, hz).run(from, steps);
}

}  // namespace gapscope::internal
