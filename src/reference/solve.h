#pragma once

#include <vector>

#include "reference/fit_problem.h"

namespace gapscope::internal::reference {

/// Initial numbers are held within about ten of their scales, unless the data says otherwise.
constexpr double kStateWidth = 10.0;

/// A point of the search: free parameters and initial states, in solver units.
struct Solution {
  std::vector<double> q;
  std::vector<RecordingStart> starts;  ///< one per recording
  double mean_square = kInfinity;      ///< of the residuals, priors included [floor²]; infinite: failed
  bool converged = false;

  bool usable() const { return mean_square < kInfinity; }
};

/// Sum of squared residuals of one recording at given parameters, in floor², by a plain run. Infinite where
/// the motion diverges.
double recording_square(const FitProblem& problem, const std::vector<double>& q, std::size_t recording,
                        const RecordingStart& start, double observer_hz);

/// Mean square residual at a point, in floor², by plain runs. Infinite where the motion diverges.
double mean_square(const FitProblem& problem, const Solution& at, double observer_hz);

/// When a local search stops.
struct Effort {
  double tolerance = 1e-6;  ///< relative decrease of the cost in an iteration
  double iterations = 1.0;  ///< in FitOptions::max_iterations
};

/// Levenberg–Marquardt within the bounds from a point, at the given observer gain (0: the free run).
Solution solve(const FitProblem& problem, const Solution& from, double observer_hz, const Effort& effort);

}  // namespace gapscope::internal::reference
