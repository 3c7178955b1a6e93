#pragma once

#include "reference/solve.h"

namespace gapscope::internal::diagnosis {

/// How far a refinement goes.
struct Work {
  int jacobians = 6;        ///< exact derivatives at most so many times
  int trials = 30;          ///< plain runs
  double tolerance = 1e-4;  ///< relative decrease of the cost at which it stops
};

/// Levenberg–Marquardt within the bounds, for many fits that start near their goal: derivatives are exact at
/// first and wherever the model of the cost fails; in between they follow the motion by Broyden's rank-one
/// formula, since a Jet run costs five to twenty plain ones. Residuals are those of the reference fit: the
/// innovations of the model run as an observer at the given gain.
reference::Solution refine(const reference::FitProblem& problem, const reference::Solution& from,
                           double observer_hz, const Work& work);

}  // namespace gapscope::internal::diagnosis
