#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "reference/solve.h"

namespace gapscope::internal {

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
