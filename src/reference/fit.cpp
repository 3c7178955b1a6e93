#include "gapscope/reference/fit.h"

#include <algorithm>
#include <cmath>

#include "reference/free_run.h"
#include "reference/identifiability.h"
#include "reference/outcome.h"
#include "reference/profile.h"
#include "reference/residual_tests.h"
#include "reference/search.h"
#include "reference/structure.h"
#include "reference/trust.h"
#include "reference/words.h"

namespace gapscope {
namespace internal::reference {
namespace {

constexpr double kWorseThanStill = 1.3;  ///< free-run error over that of a motor that stood still

FittedParameter fitted(const Parameter& p, const Determination& determined, double q, std::size_t i) {
  FittedParameter f;
  f.key = p.key, f.unit = p.unit, f.start = p.start, f.estimated = true;
  f.value = p.coordinate.physical(q);
  f.low = p.low, f.high = p.high;
  f.at_bound = p.at_bound(q);
  f.identifiable = determined.identifiable[i];
  f.std = determined.std[i];
  const double half = determined.quantile * f.std;
  if (f.identifiable) f.ci95 = {std::max(f.value - half, p.low), std::min(f.value + half, p.high)};
  return f;
}

/// An interval about a value, with an error that its likelihood does not know.
Interval widened(const Interval& i, double value, double half) {
  return {value - std::hypot(value - i.low, half), value + std::hypot(i.high - value, half)};
}

/// In the units of the numbers instead of the solver's.
std::vector<FitPiece> in_units(const FitProblem& problem, const FitPoint& at, std::vector<FitPiece> pieces) {
  std::vector<double> per_unit;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    per_unit.push_back(1.0 / problem.free_parameter(i).coordinate.slope(at.q[i]));
  for (FitPiece& p : pieces)
    for (std::size_t i = 0, k = 0; i < per_unit.size(); ++i) {
      p.slope[i] *= per_unit[i];
      for (std::size_t j = 0; j <= i; ++j, ++k) p.normal[k] *= per_unit[i] * per_unit[j];
    }
  return pieces;
}

/// @returns the simulations that profiles took
double report_parameters(const FitProblem& problem, const FitOutcome& outcome, FitSummary& summary) {
  double simulations = 0.0;
  Determination determined = determine(problem, outcome.solution, outcome.information, outcome.shift());
  judge_changes(problem, outcome, determined);
  std::size_t i = 0;
  for (const Parameter& p : problem.parameters) {
    FittedParameter f;
    f.key = p.key, f.unit = p.unit, f.start = f.value = p.start;
    if (p.estimated) {
      f = fitted(p, determined, outcome.solution.q[i], i);
      if (std::isfinite(p.impossible))
        summary.warnings.push_back(words::impossible_start(p.key, p.impossible, p.start, p.unit));
      if (f.at_bound) summary.warnings.push_back(words::at_bound(f.key, f.value, f.unit));
      if (problem.options.profile && f.identifiable) {
        const Profile profile = profile_interval(problem, outcome.solution, outcome.objective_hz, i,
                                                 {determined.own[i], determined.linear[i]});
        f.profile_ci95 = widened(profile.interval, f.value, determined.quantile * determined.timing[i]);
        simulations += profile.simulations;
      }
      ++i;
    }
    summary.parameters.push_back(f);
  }
  summary.warnings.insert(summary.warnings.end(), determined.warnings.begin(), determined.warnings.end());
  summary.advice = determined.advice;
  return simulations;
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

void report_motion(const FitProblem& problem, const FitOutcome& outcome, FitSummary& summary) {
  summary.observer_hz = problem.options.observer_hz;
  summary.objective_hz = outcome.objective_hz;
  for (std::size_t r = 0; r < problem.recordings.size(); ++r) {
    summary.traces.push_back(trace_of(problem, outcome.solution, r, summary.observer_hz));
    summary.initial_states.push_back({problem.recordings[r].file, start_state(problem, outcome.solution, r)});
  }
  summary.rmse = free_run_error(problem, summary.traces);
  summary.fit_percent = fit_percent(problem, summary.traces);
  if (const double ratio = error_over_stillness(problem, summary.traces); ratio > kWorseThanStill)
    summary.warnings.insert(summary.warnings.begin(), words::worse_than_still(ratio));
  summary.innovation_rmse = prediction_error(problem, summary.traces);
  summary.mode_errors = errors_by_mode(problem, summary.traces);
  test_residuals(problem, outcome.objective_hz == 0.0, summary);
  summary.input_timing = outcome.information.timing;
  summary.lag1_autocorrelation = outcome.information.correlation.lag1;
}

/// A fit without an answer still lists its parameters, at their starts.
void report_failure(const FitProblem& problem, FitSummary& summary) {
  summary.status = FitStatus::kFailed;
  summary.message = words::diverges();
  summary.why = words::failed_to_fit();
  for (const Parameter& p : problem.parameters) {
    FittedParameter f;
    f.key = p.key, f.unit = p.unit, f.start = p.start, f.low = p.low, f.high = p.high;
    f.estimated = p.estimated;
    if (!p.estimated) f.value = p.start;
    summary.parameters.push_back(f);
  }
}

/// Where a search was stopped, its curvature says nothing of how far the minimum is.
void drop_intervals(FitSummary& summary) {
  for (FittedParameter& p : summary.parameters) p.std = kNaN, p.ci95 = p.profile_ci95 = {};
}

}  // namespace
}  // namespace internal::reference

FitSummary fit(std::span<const MotorTrace> recordings, const ReferenceModel& model,
               const FitOptions& options) {
  using namespace internal::reference;
  const FitProblem problem = make_problem(recordings, model, options);
  FitSummary summary;
  summary.floor = pooled_floor(problem);
  const SearchResult found = find_minima(problem);
  summary.starts = static_cast<int>(found.ends.size());
  summary.start_costs = found.costs();
  double simulations = found.simulations;
  if (!found.best().usable()) {
    report_failure(problem, summary);
  } else {
    FitOutcome outcome = outcome_of(problem, found);
    try_rival_laws(problem, outcome);
    find_pressed(problem, outcome);
    summary.status = outcome.solution.converged ? FitStatus::kConverged : FitStatus::kNotConverged;
    summary.message = outcome.solution.converged ? Remark() : words::iterations_ran_out();
    summary.warnings = outcome.warnings;
    simulations += outcome.simulations + report_parameters(problem, outcome, summary);
    summary.pieces = in_units(problem, outcome.solution, outcome.information.pieces);
    tell_structure(problem, outcome, summary);
    report_motion(problem, outcome, summary);
    simulations += kSimulationsPerTrace * static_cast<double>(summary.traces.size());
    const TrustFacts facts = trust_facts(problem, found);
    judge_trust(problem, outcome, facts, summary);
    if (!summary.converged()) drop_intervals(summary);
    simulations += facts.simulations;
  }
  summary.simulations = static_cast<int>(std::lround(simulations));
  return summary;
}

void FitOptions::fields(FieldVisitor& v) {
  v.field({"starts", "", "local searches at most", 1, 1000}, starts);
  v.field({"max_iterations", "", "of each local search", 1, 10000}, max_iterations);
  v.field({"observer_hz", "Hz", "poles of the observer in the search", 0.01, 1000}, observer_hz);
  v.field({"rejected_hz", "Hz", "poles when the model does not reach the encoder floor", 0.01, 1000},
          rejected_hz);
  v.field({"rejected_ratio", "", "prediction error in encoder floors above which the model is not the drive",
           1, 1e6},
          rejected_ratio);
  v.field({"loss_width", "rad", "Huber width; 0: plain least squares", 0}, loss_width);
  v.field({"max_condition", "", "condition above which a combination is not identifiable", 1}, max_condition);
  v.field({"seed", "", "of the starting points"}, seed);
  v.field({"compare_parts", "", "where the model is not the drive: compare its values between parts"},
          compare_parts);
  v.field({"profile", "", "intervals from the profile likelihood as well"}, profile);
  v.field({"gap_seed", "rad", "the gap by another estimate, about which every second start is drawn", 0},
          gap_seed);
}

}  // namespace gapscope
