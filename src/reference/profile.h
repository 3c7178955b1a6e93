#pragma once

#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// Standard errors of one parameter [its unit]: as reported, and that of white residuals of one floor.
struct ParameterError {
  double reported = kNaN, linear = kNaN;
};

/// An interval, and what it took.
struct Profile {
  Interval interval;
  double simulations = 0.0;
};

/// Where the cost, all other numbers fitted anew, is higher by what 95 % allow: an increase of
/// (kNormal95 · reported/linear)² floors², so that it is the usual interval where the cost is a parabola. An
/// end that is not met within the bounds is the bound.
/// @param i  place among the free parameters
Profile profile_interval(const FitProblem& problem, const FitPoint& at, double observer_hz, std::size_t i,
                         const ParameterError& error);

}  // namespace gapscope::internal::reference
