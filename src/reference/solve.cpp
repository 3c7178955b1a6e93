#include "reference/solve.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "gapscope/base/interrupt.h"
#include "reference/recording_cost.h"

namespace gapscope::internal::reference {
namespace {

/// (p − prior)/std of one free parameter.
class PriorCost final : public ceres::CostFunction {
 public:
  PriorCost(const Parameter& parameter, std::size_t place, std::size_t count)
      : parameter_(parameter), place_(place) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const double q = blocks[0][place_];
    residuals[0] = (parameter_.coordinate.physical(q) - parameter_.prior->value) / parameter_.prior->std;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
    jacobians[0][place_] = parameter_.coordinate.slope(q) / parameter_.prior->std;
    return true;
  }

 private:
  const Parameter& parameter_;
  std::size_t place_;
};

class StateWidthCost final : public ceres::CostFunction {
 public:
  explicit StateWidthCost(std::size_t count) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int n = num_residuals();
    for (int i = 0; i < n; ++i) residuals[i] = blocks[0][i] / kStateWidth;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill_n(jacobians[0], n * n, 0.0);
    for (int i = 0; i < n; ++i) jacobians[0][i * n + i] = 1.0 / kStateWidth;
    return true;
  }
};

/// The blocks of one search. Ceres takes over the cost functions.
class Solver {
 public:
  Solver(const FitProblem& problem, const Solution& from, double observer_hz)
      : problem_(problem), shared_(from.q), states_(from.starts.size()) {
    if (!shared_.empty()) add_parameters();
    for (std::size_t r = 0; r < from.starts.size(); ++r) add_recording(r, from.starts[r], observer_hz);
  }

  ceres::Solver::Summary run(const ceres::Solver::Options& options) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    return summary;
  }

  void read_back(Solution& solution) const {
    solution.q = shared_;
    for (std::size_t r = 0; r < states_.size(); ++r)
      for (std::size_t i = 0; i < free_[r].size(); ++i)
        solution.starts[r].q[static_cast<std::size_t>(free_[r][i])] = states_[r][i];
  }

 private:
  void add_parameters() {
    const int n = static_cast<int>(shared_.size());
    ceres_.AddParameterBlock(shared_.data(), n);
    for (int i = 0; i < n; ++i) {
      const Parameter& p = problem_.free_parameter(static_cast<std::size_t>(i));
      ceres_.SetParameterLowerBound(shared_.data(), i, p.coordinate.solver(p.low));
      ceres_.SetParameterUpperBound(shared_.data(), i, p.coordinate.solver(p.high));
      if (p.prior)
        ceres_.AddResidualBlock(new PriorCost(p, static_cast<std::size_t>(i), shared_.size()), nullptr,
                                shared_.data());
    }
  }

  void add_recording(std::size_t r, const RecordingStart& start, double observer_hz) {
    auto cost = std::make_unique<RecordingCost>(problem_, r, start, observer_hz);
    free_.push_back(cost->states());
    for (const int s : cost->states()) states_[r].push_back(start.q[static_cast<std::size_t>(s)]);
    std::vector<double*> blocks;
    if (!shared_.empty()) blocks.push_back(shared_.data());
    if (!states_[r].empty()) {
      blocks.push_back(states_[r].data());
      ceres_.AddResidualBlock(new StateWidthCost(states_[r].size()), nullptr, states_[r].data());
    }
    if (!blocks.empty()) ceres_.AddResidualBlock(cost.release(), nullptr, blocks);
  }

  const FitProblem& problem_;
  std::vector<double> shared_;
  std::vector<std::vector<double>> states_;
  std::vector<std::vector<int>> free_;
  ceres::Problem ceres_;
};

/// A search that ends badly is a result here; Ceres would also write it to standard error.
void silence_ceres() {
  static const bool silent = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  (void)silent;
}

ceres::Solver::Options solver_options(const FitOptions& options, const Effort& effort) {
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;  // a few columns, scaled by Ceres
  o.max_num_iterations = std::max(1, static_cast<int>(effort.iterations * options.max_iterations));
  o.function_tolerance = effort.tolerance;
  o.parameter_tolerance = 1e-3 * effort.tolerance;
  o.gradient_tolerance = 0.0;  // in scaled units it has no meaning of its own
  o.max_num_consecutive_invalid_steps = 10;
  o.max_trust_region_radius = 1e10;  // keeps the normal matrix positive along null directions
  o.logging_type = ceres::SILENT;
  o.num_threads = 1;
  o.use_nonmonotonic_steps = true;  // valleys bend, and every change in the order of events is a kink
  return o;
}

double prior_square(const FitProblem& problem, const Solution& at) {
  double sum = 0.0;
  for (std::size_t i = 0; i < at.q.size(); ++i) {
    const Parameter& p = problem.free_parameter(i);
    if (p.prior) sum += std::pow((p.coordinate.physical(at.q[i]) - p.prior->value) / p.prior->std, 2);
  }
  return sum;
}

}  // namespace

double recording_square(const FitProblem& problem, const std::vector<double>& shared, std::size_t recording,
                        const RecordingStart& start, double observer_hz) {
  const RecordingCost cost(problem, recording, start, observer_hz);
  std::vector<double> q = shared;
  for (const int s : cost.states()) q.push_back(start.q[static_cast<std::size_t>(s)]);
  std::vector<double> residuals(problem.recordings[recording].size());
  if (!cost.evaluate(q.data(), residuals.data(), nullptr)) return kInfinity;
  double sum = 0.0;
  for (const double v : residuals) sum += v * v;
  return std::isfinite(sum) ? sum : kInfinity;
}

double mean_square(const FitProblem& problem, const Solution& at, double observer_hz) {
  double sum = prior_square(problem, at), count = 0.0;
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    sum += recording_square(problem, at.q, r, at.starts[r], observer_hz);
    count += static_cast<double>(problem.recordings[r].size());
  }
  return sum / count;
}

Solution solve(const FitProblem& problem, const Solution& from, double observer_hz, const Effort& effort) {
  Solution to = from;
  to.mean_square = kInfinity;
  to.converged = false;
  silence_ceres();
  Solver search(problem, from, observer_hz);
  const ceres::Solver::Summary summary = search.run(solver_options(problem.options, effort));
  stop_point();  // once asked to stop, no evaluation succeeds
  if (summary.termination_type == ceres::FAILURE || !summary.IsSolutionUsable()) return to;
  search.read_back(to);
  to.converged = summary.termination_type == ceres::CONVERGENCE;
  to.mean_square = mean_square(problem, to, observer_hz);
  return to;
}

}  // namespace gapscope::internal::reference
