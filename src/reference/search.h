#pragma once

#include <vector>

#include "reference/solvers.h"

namespace gapscope::internal::reference {

/// Innovations within this many floors, and
constexpr double kAtFloor = 1.3;
/// no more correlated than a quantiser's: nothing but the encoder is left.
constexpr double kWhite = 0.15;

/// Result of the starts.
struct SearchResult {
  std::vector<Solution> ends;  ///< of the searches that did not fail, least mean square first
  double simulations = 0.0;    ///< spent on all of them

  Solution best() const { return ends.empty() ? Solution{} : ends.front(); }
  std::vector<double> costs() const;  ///< final mean squares [floor²]
};

/// Least squares of the observer's innovations from several starting points. Each search runs on a growing
/// first part of the recordings, which has few events and so few minima, before it sees all of them. The
/// given values go first; unless they end at the encoder's floor, draws compete on short parts and the
/// survivors follow.
SearchResult find_minima(const FitProblem& problem);

}  // namespace gapscope::internal::reference
