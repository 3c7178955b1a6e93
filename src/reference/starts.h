#pragma once

#include <vector>

#include "reference/solve.h"

namespace gapscope::internal::reference {

/// Where the load may have been when a recording began.
std::vector<InitialVariant> initial_variants(const FitProblem& problem, const RecordingStart& start);

/// The point of the given parameters with each recording's initial state as its first samples show it.
Solution start_point(const FitProblem& problem, std::vector<double> q);

/// Gives each recording the initial place of the load that fits best at the present parameters (recordings
/// are independent of each other in it). @returns whether any recording changed.
bool choose_variants(const FitProblem& problem, Solution& at, double observer_hz);

/// Whether every free parameter has a value of the user's, not one that the recordings suggest.
bool values_are_given(const FitProblem& problem);

/// The given (or derived) values.
Solution given_point(const FitProblem& problem);

/// Draws, log-uniform around given values (×÷3) and over the plausible range of those that were not given:
/// of several each, the ones that fit the first part of the recordings best. They depend on the seed alone.
std::vector<Solution> drawn_points(const FitProblem& problem, std::size_t count);

}  // namespace gapscope::internal::reference
