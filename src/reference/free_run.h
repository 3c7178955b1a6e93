#pragma once

#include <vector>

#include "gapscope/reference/fit_summary.h"
#include "reference/fit_problem.h"

namespace gapscope::internal::reference {

/// State of a solution at the first sample of recording r.
DriveState<double> start_state(const FitProblem& problem, const FitPoint& at, std::size_t r);

inline constexpr double kSimulationsPerTrace = 2.0;

/// Free run and one-step prediction of a solution beside recording r. Empty columns where the motion
/// diverges.
FitTrace trace_of(const FitProblem& problem, const FitPoint& at, std::size_t r, double observer_hz);

/// Root mean square of recorded − modelled x1 over all recordings [rad]; NaN without traces.
double free_run_error(const FitProblem& problem, const std::vector<FitTrace>& traces);
double prediction_error(const FitProblem& problem, const std::vector<FitTrace>& traces);

/// Free-run error over that of a motor that stood still, the smaller of two: of x1, and of the way made in a
/// hundredth of each recording, since a free run drifts far from a closed loop although it moves alike.
double error_over_stillness(const FitProblem& problem, const std::vector<FitTrace>& traces);

/// Free-run error in each mode of the fitted model that occurs.
std::vector<ModeError> errors_by_mode(const FitProblem& problem, const std::vector<FitTrace>& traces);

}  // namespace gapscope::internal::reference
