#pragma once

#include <vector>

#include "reference/solve.h"

namespace gapscope::internal {

/// Where the load may have been when a recording began.
std::vector<InitialVariant> initial_variants(const FitProblem& problem, const RecordingStart& start);

/// The point of the given parameters with each recording's initial state as its first samples show it.
Solution start_point(const FitProblem& problem, std::vector<double> q);

/// Gives each recording the initial place of the load that fits best at the present parameters (recordings
/// are independent of each other in it). @returns whether any recording changed.
bool choose_variants(const FitProblem& problem, Solution& at, double observer_hz);

/// Starting points, most promising first: the given values, then own draws, log-uniform around given values
/// (×÷1.6) and over the plausible range of those that were not given. The draws depend on the seed alone.
std::vector<Solution> starting_points(const FitProblem& problem, double observer_hz);

}  // namespace gapscope::internal
