#pragma once

#include <string>
#include <vector>

#include "reference/identifiability.h"
#include "reference/search.h"

namespace gapscope::internal::reference {

constexpr double kBeyondChance = 9.0;  ///< χ² of one number, three standard errors

/// How far the free parameters move when they are fitted in another way.
struct ValueChange {
  Remark where;                  ///< "at 10 Hz instead of 30 Hz", "between ..."
  std::vector<double> from, to;  ///< [units of the parameters]
  double weight = 1.0;           ///< of the difference as a standard error
  bool parts = false;            ///< between parts of the recordings
};

/// What another law of contact or friction, or another start, makes of the recordings.
struct RivalFit {
  std::string law;                ///< in words
  double gap = kNaN;              ///< [rad]
  double advantage = -kInfinity;  ///< fall of the cost against the fit's own, in what chance alone gains

  bool explains() const { return advantage > -1.0; }
  bool explains_better() const { return advantage > 1.0; }
};

/// The values that are reported, and how they were had.
struct FitOutcome {
  Solution solution;
  double objective_hz = 0.0;  ///< poles of the observer; 0: the free run
  Information information;
  std::vector<ValueChange> changes;
  std::vector<double> spread;    ///< of the free parameters over minima that are nearly as good; may be empty
  std::vector<RivalFit> rivals;  ///< other laws, refitted from the solution
  std::vector<std::string> pressed;  ///< keys of the numbers that a bound keeps from a better fit
  std::vector<Remark> warnings;
  double simulations = 0.0;

  std::vector<double> shift()
      const;  ///< all changes and the spread together, per free parameter; empty without any
};

/// Takes the end of the search to the values that are reported, see fit(): the free run where the predictions
/// reach the encoder's floor, else the end that predicts best at a higher gain, compared with another gain
/// and between parts of the recordings.
FitOutcome outcome_of(const FitProblem& problem, const SearchResult& found);

/// The same of the end of a search whose predictions are near the floor: is_rejected() says whether.
FitOutcome outcome_near_floor(const FitProblem& problem, const Solution& found);
bool is_rejected(const FitProblem& problem, const Solution& found);

/// Names the parameters that change by more than their own intervals. A gap that is another one on another
/// part of the recordings is no gap: it is not identifiable.
void judge_changes(const FitProblem& problem, const FitOutcome& outcome, Determination& determined);

}  // namespace gapscope::internal::reference
