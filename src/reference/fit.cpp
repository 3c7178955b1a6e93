#include "gapscope/reference/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/free_run.h"
#include "reference/identifiability.h"
#include "reference/polish.h"
#include "reference/search.h"

namespace gapscope {
namespace internal {
namespace {

constexpr Effort kRejected{1e-6, 1.0};     ///< of a model that is not the drive
constexpr Effort kOtherGain{1e-4, 0.5};    ///< of the change to another gain
constexpr double kSlowObserver = 0.2;      ///< of the search's gain, where a free run goes astray
constexpr double kSecondGain = 1.0 / 3.0;  ///< of rejected_hz

/// The values that are reported, and how they were had.
struct Outcome {
  Solution solution;
  double objective_hz = 0.0;
  Information information;
  std::vector<double> shift;  ///< of the free parameters to another gain
  std::vector<std::string> warnings;
};

std::vector<double> values_of(const FitProblem& problem, const Solution& s) {
  std::vector<double> values;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    values.push_back(problem.free_parameter(i).coordinate.physical(s.q[i]));
  return values;
}

void take(const FitProblem& problem, const Solution& solution, double hz, Outcome& outcome) {
  outcome.solution = solution;
  outcome.objective_hz = hz;
  outcome.information = information_at(problem, solution, hz);
}

/// Values at one gain, their change to a lower one as an error.
void take_two_gains(const FitProblem& problem, const Solution& from, double hz, double other_hz,
                    Outcome& outcome) {
  const Solution found = solve(problem, from, hz, kRejected);
  take(problem, found.usable() ? found : from, found.usable() ? hz : problem.options.observer_hz, outcome);
  const Solution other = solve(problem, outcome.solution, other_hz, kOtherGain);
  if (!other.usable()) return;
  const std::vector<double> here = values_of(problem, outcome.solution), there = values_of(problem, other);
  for (std::size_t i = 0; i < here.size(); ++i) outcome.shift.push_back(std::abs(here[i] - there[i]));
}

Outcome finish(const FitProblem& problem, const Solution& best) {
  const FitOptions& o = problem.options;
  Outcome outcome;
  const double innovations = std::sqrt(best.mean_square);
  if (innovations > o.rejected_ratio) {
    outcome.warnings.push_back(
        fmt::format("the model does not explain the recordings: its prediction error is {:.3g} times the "
                    "encoder's floor. Values "
                    "are those of an observer at {:.3g} Hz; intervals hold their scatter over windows and "
                    "gains, not what the "
                    "missing physics may bias.",
                    innovations, o.rejected_hz));
    take_two_gains(problem, best, o.rejected_hz, kSecondGain * o.rejected_hz, outcome);
    return outcome;
  }
  const Solution polished = polish(problem, best);
  if (polished.usable() && std::sqrt(polished.mean_square) <= o.rejected_ratio) {
    take(problem, polished, 0.0, outcome);
    const Correlation& correlation = outcome.information.correlation;
    if (correlation.excess() > kWhite)
      outcome.warnings.push_back(
          fmt::format("the residual is within the encoder's size but not random (lag-1 autocorrelation "
                      "{:.2f}, the quantiser "
                      "explains {:.2f}): something small is missing or another minimum is better, and the "
                      "intervals assume "
                      "neither.",
                      correlation.lag1, correlation.quantiser));
    return outcome;
  }
  outcome.warnings.push_back(
      fmt::format("the free run departs from the recordings although the predictions do not: values are "
                  "those of an observer at "
                  "{:.3g} Hz.",
                  kSlowObserver * o.observer_hz));
  take_two_gains(problem, best, kSlowObserver * o.observer_hz, o.observer_hz, outcome);
  return outcome;
}

bool at_bound(const Parameter& p, double q) {
  const double low = p.coordinate.solver(p.low), high = p.coordinate.solver(p.high);
  const double near = 1e-6 * (high - low);
  return q <= low + near || q >= high - near;
}

void report_parameters(const FitProblem& problem, const Outcome& outcome, FitSummary& summary) {
  Determined determined = determine(problem, outcome.solution, outcome.information, outcome.shift);
  std::size_t i = 0;
  for (const Parameter& p : problem.parameters) {
    FittedParameter f;
    f.key = p.key, f.unit = p.unit, f.start = f.value = p.start, f.estimated = p.estimated;
    if (p.estimated) {
      f.value = p.coordinate.physical(outcome.solution.q[i]);
      f.low = p.low, f.high = p.high;
      f.at_bound = at_bound(p, outcome.solution.q[i]);
      f.identifiable = determined.identifiable[i];
      f.std = determined.std[i];
      const double half = determined.quantile * f.std;
      if (f.identifiable) f.ci95 = {std::max(f.value - half, p.low), std::min(f.value + half, p.high)};
      if (f.at_bound)
        summary.warnings.push_back(fmt::format("{} ended at its bound {:.4g} {}.", f.key, f.value, f.unit));
      ++i;
    }
    summary.parameters.push_back(f);
  }
  summary.warnings.insert(summary.warnings.end(), determined.warnings.begin(), determined.warnings.end());
}

double pooled_floor(const FitProblem& problem) {
  double sum = 0.0, count = 0.0;
  for (std::size_t r = 0; r < problem.floors.size(); ++r) {
    const double n = static_cast<double>(problem.recordings[r].size());
    sum += n * problem.floors[r] * problem.floors[r];
    count += n;
  }
  return std::sqrt(sum / count);
}

void report_motion(const FitProblem& problem, const Outcome& outcome, FitSummary& summary) {
  summary.observer_hz = problem.options.observer_hz;
  summary.objective_hz = outcome.objective_hz;
  for (std::size_t r = 0; r < problem.recordings.size(); ++r)
    summary.traces.push_back(trace_of(problem, outcome.solution, r, summary.observer_hz));
  summary.rmse = free_run_error(problem, summary.traces);
  summary.innovation_rmse = prediction_error(problem, summary.traces);
  summary.mode_errors = errors_by_mode(problem, summary.traces);
  summary.lag1_autocorrelation = outcome.information.correlation.lag1;
}

/// A fit without an answer still lists its parameters, at their starts.
void report_failure(const FitProblem& problem, FitSummary& summary) {
  summary.status = FitStatus::kFailed;
  summary.message = "the simulated motion diverges from every starting point.";
  for (const Parameter& p : problem.parameters) {
    FittedParameter f;
    f.key = p.key, f.unit = p.unit, f.start = p.start, f.low = p.low, f.high = p.high;
    f.estimated = p.estimated;
    if (!p.estimated) f.value = p.start;
    summary.parameters.push_back(f);
  }
}

}  // namespace
}  // namespace internal

FitSummary fit(std::span<const MotorTrace> recordings, const ReferenceModel& model,
               const FitOptions& options) {
  using namespace internal;
  const FitProblem problem = make_problem(recordings, model, options);
  FitSummary summary;
  summary.floor = pooled_floor(problem);
  const SearchResult found = search(problem);
  summary.starts = static_cast<int>(found.costs.size());
  summary.start_costs = found.costs;
  if (!found.best.usable()) {
    report_failure(problem, summary);
  } else {
    const Outcome outcome = finish(problem, found.best);
    summary.status = outcome.solution.converged ? FitStatus::kConverged : FitStatus::kNotConverged;
    summary.message = outcome.solution.converged ? "" : "the iterations ran out before the cost settled.";
    summary.warnings = outcome.warnings;
    report_parameters(problem, outcome, summary);
    report_motion(problem, outcome, summary);
  }
  summary.simulations = static_cast<int>(std::lround(problem.simulations));
  return summary;
}

void FitOptions::fields(FieldVisitor& v) {
  v.field({"starts", "", "local searches at most", 1, 1000}, starts);
  v.field({"max_iterations", "", "of each local search", 1, 10000}, max_iterations);
  v.field({"observer_hz", "Hz", "poles of the observer in the search", 0.01, 1000}, observer_hz);
  v.field({"rejected_hz", "Hz", "poles when the model does not reach the encoder's floor", 0.01, 1000},
          rejected_hz);
  v.field({"rejected_ratio", "", "prediction error in floors above which the model is not the drive", 1, 1e6},
          rejected_ratio);
  v.field({"loss_width", "rad", "Huber width; 0: plain least squares", 0}, loss_width);
  v.field({"max_condition", "", "condition above which a combination is not identifiable", 1}, max_condition);
  v.field({"seed", "", "of the starting points"}, seed);
  v.field({"gap_seed", "rad", "start of the gap from another estimate", 0}, gap_seed);
}

}  // namespace gapscope
