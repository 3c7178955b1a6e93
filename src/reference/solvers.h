#pragma once

#include "reference/cost.h"

namespace gapscope::internal::reference {

// Three ways down the same cost (cost.h), all within the bounds:
//   solve    Levenberg–Marquardt of Ceres, exact derivatives in every iteration, steps uphill allowed: from
//            afar and to the last digit. For fit().
//   refine   Levenberg–Marquardt with few exact derivatives: for the many fits of a diagnosis that start near
//            their goal.
//   adjust   Gauss–Newton with derivatives that were taken elsewhere, plain runs only: to tell which of many
//            starts is worth a refinement.
// Each returns what it minimised under a name of its own: mean_square_with_priors, mean_cost and
// residual_mean_square are not the same number at the same point.

/// When solve() stops.
struct Effort {
  double tolerance = 1e-6;  ///< relative decrease of the cost in an iteration
  double iterations = 1.0;  ///< in FitOptions::max_iterations
};

/// Where solve() ended.
struct Solution : FitPoint {
  double mean_square_with_priors = kInfinity;  ///< see there [floor²]; infinite: failed
  bool converged = false;
  double simulations = 0.0;  ///< spent on it

  bool usable() const { return mean_square_with_priors < kInfinity; }
};

inline bool leaves_less(const Solution& a, const Solution& b) {
  return a.mean_square_with_priors < b.mean_square_with_priors;
}

/// From a point, at the given observer gain (0: the free run).
Solution solve(const FitProblem& problem, const FitPoint& from, double observer_hz, const Effort& effort);

/// Derivatives are exact at first and wherever the model of the cost fails; in between they follow the motion
/// by Broyden's rank-one formula, since a Jet run costs three to nine plain ones.
RefinedFit refine(const FitProblem& problem, const FitPoint& from, double observer_hz,
                  const RefineEffort& effort);

/// Residuals of one recording and their derivatives by the shared numbers.
struct LinearResiduals {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd derivatives;  // (samples × shared)
};

/// Both at a point, by Jet runs. Empty if the motion diverges.
std::vector<LinearResiduals> linearise(const FitProblem& problem, const FitPoint& at, double observer_hz);

/// Moves the first numbers of a point as long as that helps; the rest stays. One plain run for the cost, one
/// a step.
AdjustedFit adjust(const FitProblem& problem, const FitPoint& from, std::span<const LinearResiduals> borrowed,
                   double observer_hz, int steps);

/// See ModelFit::sine_start().
std::optional<SineStart> sine_start(const FitProblem& problem, const FitPoint& at,
                                    std::span<const LinearResiduals> borrowed, double small,
                                    double observer_hz);

}  // namespace gapscope::internal::reference
