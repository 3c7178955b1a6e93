#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "reference/solve.h"

namespace gapscope::internal {

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
Solution refine(const FitProblem& problem, const Solution& from, double observer_hz, const Work& work);

/// Residuals of one recording and their derivatives by the shared numbers.
struct Linear {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd derivatives;  // (samples × shared)
};

/// Both at a point, by Jet runs. Empty if the motion diverges.
std::vector<Linear> linearise(const FitProblem& problem, const Solution& at, double observer_hz);

/// Moves the first numbers of a point by Gauss–Newton steps with derivatives that were taken elsewhere, as
/// long as that helps; the rest stays. Plain runs only: one for the cost, one a step.
Solution adjust(const FitProblem& problem, const Solution& from, std::span<const Linear> borrowed,
                double observer_hz, int steps);

}  // namespace gapscope::internal
