#pragma once

#include "gapscope/reference/fit.h"

namespace gapscope {

/// The model with the numbers in it that a fit has found; those that it has not stay.
ReferenceModel with_fitted_numbers(ReferenceModel model, const FitSummary& fit);

}  // namespace gapscope
