#pragma once

#include <vector>

#include "base/normal.h"
#include "gapscope/base/remark.h"
#include "reference/information.h"

namespace gapscope::internal::reference {

/// What could be determined of each free parameter, in the order of FitProblem::free.
struct Determination {
  std::vector<double> std;  ///< [unit of the parameter]; NaN where it is not identifiable
  std::vector<bool> identifiable;
  std::vector<double> own;      ///< std before changes to another gain or part count
  std::vector<double> linear;   ///< std of white residuals of one floor
  std::vector<double> timing;   ///< std of what the timing of the input leaves open
  double quantile = kNormal95;  ///< half width of the 95 % interval in std
  std::vector<Remark> advice;   ///< what would sharpen the parameters that are known least
  std::vector<Remark> warnings;
};

/// Standard errors, and what is not determined:
/// - alone: a column of the Jacobian is (nearly) zero;
/// - in combination: an eigenvector of the normalised JᵀJ with a relative eigenvalue below 1/max_condition;
/// - in practice: the standard error exceeds the parameter itself.
/// The variance of a parameter is that of variance_along(), with what the timing of the input leaves open.
/// @param shift  change of each free parameter [its unit] to another observer gain, counted as an error of
/// its own
Determination determine(const FitProblem& problem, const FitPoint& at, const Information& information,
                        const std::vector<double>& shift = {});

}  // namespace gapscope::internal::reference
