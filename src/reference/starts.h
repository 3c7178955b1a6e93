#pragma once

#include <vector>

#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// Where the load may have been when a recording began.
std::vector<InitialVariant> initial_variants(const FitProblem& problem, const RecordingStart& start);

/// The point of the given parameters with each recording's initial state as its first samples show it.
FitPoint start_point(const FitProblem& problem, std::vector<double> q);

/// Where the loads are best placed at the beginning of the recordings.
struct Placement {
  std::vector<RecordingStart> starts;
  bool changed = false;  ///< from where they were
  double simulations = 0.0;
};

/// The initial place of the load in each recording that fits best at the present parameters (recordings are
/// independent of each other in it).
Placement choose_variants(const FitProblem& problem, const FitPoint& at, double observer_hz);

/// Whether every free parameter has a value of the user's, not one that the recordings suggest.
bool values_are_given(const FitProblem& problem);

/// The given (or derived) values.
FitPoint given_point(const FitProblem& problem);

/// Points to search from, best first, and what it took to find them.
struct StartPoints {
  std::vector<Solution> points;
  double simulations = 0.0;
};

/// Draws, log-uniform around given values (×÷3) and over the plausible range of those that were not given:
/// of several each, the ones that fit the first part of the recordings best. They depend on the seed alone.
StartPoints drawn_points(const FitProblem& problem, std::size_t count);

}  // namespace gapscope::internal::reference
