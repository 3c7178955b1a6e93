#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "reference/solve.h"

namespace gapscope::internal::diagnosis {

/// Residuals of one recording and their derivatives by the shared numbers.
struct Linear {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd derivatives;  // (samples × shared)
};

/// Both at a point, by Jet runs. Empty if the motion diverges.
std::vector<Linear> linearise(const reference::FitProblem& problem, const reference::Solution& at,
                              double observer_hz);

/// Moves the first numbers of a point by Gauss–Newton steps with derivatives that were taken elsewhere, as
/// long as that helps; the rest stays. Plain runs only: one for the cost, one a step.
reference::Solution adjust(const reference::FitProblem& problem, const reference::Solution& from,
                           std::span<const Linear> borrowed, double observer_hz, int steps);

/// Where the search for a sine begins.
struct SineStart {
  double amplitude = 0.0;  ///< in the unit of the effect
  double phase = 0.0;      ///< [rad]
};

/// Amplitude and phase of a sine, the last two numbers of a problem, that explain with all the others what a
/// model without it leaves: both quarters of the sine act in proportion to their size while it is small.
/// @param borrowed residuals without the sine, derivatives by the other numbers
/// @param small size of the sine at which its action is tried
std::optional<SineStart> sine_start(const reference::FitProblem& problem, const reference::Solution& at,
                                    std::span<const Linear> borrowed, double small, double observer_hz);

}  // namespace gapscope::internal::diagnosis
