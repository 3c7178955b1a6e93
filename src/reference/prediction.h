#pragma once

#include <span>

#include "reference/information.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// Covariance of the free parameters, in solver units, by two readings of the residuals, of which the larger
/// holds. Directions that the fit does not determine at all count for nothing here, see determine().
struct Covariances {
  Eigen::MatrixXd white;    ///< of autocorrelated residuals; empty: the motion diverges
  Eigen::MatrixXd scatter;  ///< of the scatter of the windows' scores
};
Covariances covariances_at(const FitProblem& fitted, const FitPoint& at, double observer_hz);

/// What a fit leaves open of another motion, to first order: the standard deviation of its prediction, rms
/// over the samples [floor], by the larger covariance sample by sample. NaN where a motion diverges.
/// @param there derivatives of the other motion by the shared numbers
double prediction_std(const FitProblem& fitted, const FitPoint& at, std::span<const LinearResiduals> there,
                      double observer_hz);

}  // namespace gapscope::internal::reference
