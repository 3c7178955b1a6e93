#pragma once

#include "reference/fit_problem.h"

namespace gapscope::internal::reference {

/// Correlations of what the fit leaves, at lags spaced geometrically up to a tenth of the recordings, each
/// against the band that holds 95 % of the lags where nothing is left:
///   whiteness          r(k) = Σ e_i e_{i+k} / Σ e²,               band ±1.96/√n
///   input correlation  c(k) = Σ u_i e_{i+k} / √(Σ u² Σ e²),       band ±1.96/√n · √(Σ_j ρ_e(j) ρ_u(j))
/// (Bartlett's formula), e without its mean. A model that lacks something leaves both outside.
/// @param free_run  of the free run, else of the one-step predictions
void test_residuals(const FitProblem& problem, bool free_run, FitSummary& summary);

}  // namespace gapscope::internal::reference
