#pragma once

#include <vector>

#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// A minimum of the free run, and the others that were met beside it.
struct FreeRunMinima {
  Solution best;
  std::vector<Solution> others;
  double simulations = 0.0;
};

/// Least squares of the free run from where the search ended. A free run through many impacts has narrow
/// minima side by side, one for each order of bounces: where it ends above the predictions, it is tried again
/// over growing parts of the recordings and from points nearby, and the best one counts.
/// @param found  end of the search; its mean square is that of the predictions
FreeRunMinima polish(const FitProblem& problem, const Solution& found);

}  // namespace gapscope::internal::reference
