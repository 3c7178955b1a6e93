#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>

#include "base/interrupt.h"
#include "reference/ceres_terms.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {
namespace {

/// The cost in the blocks of Ceres, which takes over its terms.
class CeresSearch {
 public:
  CeresSearch(const FitProblem& problem, const FitPoint& from, double observer_hz)
      : cost_(problem, from, observer_hz), x_(cost_.pack(from)) {
    if (cost_.shared() > 0) add_parameters();
    for (std::size_t r = 0; r < cost_.recordings(); ++r) add_recording(r);
  }

  ceres::Solver::Summary run(const ceres::Solver::Options& options) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    return summary;
  }

  FitPoint point() const { return cost_.unpack(x_); }
  double simulations() const { return simulations_; }

 private:
  void add_parameters() {
    const int n = static_cast<int>(cost_.shared());
    const Cost::Vector low = cost_.low(), high = cost_.high();
    ceres_.AddParameterBlock(x_.data(), n);
    for (int i = 0; i < n; ++i) {
      const auto place = static_cast<std::size_t>(i);
      const Parameter& p = cost_.problem().free_parameter(place);
      ceres_.SetParameterLowerBound(x_.data(), i, low[i]);
      ceres_.SetParameterUpperBound(x_.data(), i, high[i]);
      if (p.prior)
        ceres_.AddResidualBlock(new PriorTerm(p, place, static_cast<std::size_t>(n)), nullptr, x_.data());
    }
  }

  void add_recording(std::size_t r) {
    std::vector<double*> blocks;
    if (cost_.shared() > 0) blocks.push_back(x_.data());
    if (cost_.states(r) > 0) {
      double* const states = x_.data() + cost_.first_state(r);
      blocks.push_back(states);
      ceres_.AddResidualBlock(new StateWidthTerm(static_cast<std::size_t>(cost_.states(r))), nullptr, states);
    }
    if (blocks.empty()) return;
    ceres_.AddResidualBlock(new RecordingTerm(cost_.recording(r), simulations_), nullptr, blocks);
  }

  Cost cost_;
  Cost::Vector x_;
  double simulations_ = 0.0;
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

/// Whether what was gained in the second half of the iterations moves no value by a third of its standard
/// error: then the search has only wandered among the kinks of a quantised motion, whatever it might still
/// gain. `Fit.RecoversGapDampingAndMassRatioOfWhichNothingWasSaid` ends at the truth and still creeps along a
/// direction that the recording leaves open, 0.045 in 60 iterations: half and double of kTrifle take it for
/// settled, a tenth does not.
bool has_settled(const FitProblem& problem, const ceres::Solver::Summary& summary) {
  constexpr double kTrifle = 0.1;  // of the cost in variances of a sample, (a third of a standard error)²
  constexpr std::size_t kFewest = 20;
  const auto& all = summary.iterations;
  if (all.size() < kFewest) return false;
  double before = kInfinity, samples = 0.0;
  for (std::size_t i = 0; i < all.size() / 2; ++i) before = std::min(before, all[i].cost);
  for (const MotorTrace& r : problem.recordings) samples += static_cast<double>(r.size());
  return (before - summary.final_cost) * samples < kTrifle * summary.final_cost;
}

}  // namespace

Solution solve(const FitProblem& problem, const FitPoint& from, double observer_hz, const Effort& effort) {
  silence_ceres();
  CeresSearch search(problem, from, observer_hz);
  const ceres::Solver::Summary summary = search.run(solver_options(problem.options, effort));
  stop_point();  // once asked to stop, no evaluation succeeds
  Solution to{from};
  to.simulations = search.simulations();
  if (summary.termination_type == ceres::FAILURE || !summary.IsSolutionUsable()) return to;
  static_cast<FitPoint&>(to) = search.point();
  to.converged = summary.termination_type == ceres::CONVERGENCE || has_settled(problem, summary);
  const Square left = mean_square_with_priors(problem, to, observer_hz);
  to.mean_square_with_priors = left.value;
  to.simulations += left.simulations;
  return to;
}

}  // namespace gapscope::internal::reference
