#pragma once

#include <span>

#include "reference/information.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// What a fit leaves open of another motion, to first order: the standard deviation of its prediction, rms
/// over the samples [floor]. The covariance of the shared numbers is the larger, sample by sample, of that of
/// autocorrelated residuals and that of the scatter of the windows' scores. Directions that the fit does not
/// determine at all count for nothing here, see determine(). NaN where a motion diverges.
/// @param there derivatives of the other motion by the shared numbers
double prediction_std(const FitProblem& fitted, const FitPoint& at, std::span<const LinearResiduals> there,
                      double observer_hz);

}  // namespace gapscope::internal::reference
