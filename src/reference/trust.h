#pragma once

#include "reference/outcome.h"

namespace gapscope::internal::reference {

/// What the trust in a fit rests on beside its own error: prediction errors of the observer at observer_hz.
struct TrustFacts {
  double coasting_rmse = kNaN;      ///< of one that knows no torque, over all recordings [rad]
  double without_gap_ratio = kNaN;  ///< of the best model whose gap is closed, over that with it open [-];
                                    ///< NaN: none is estimated
  double simulations = 0.0;         ///< spent on it
};

/// The search is gone through once more with the gap held at zero, from where it ended.
TrustFacts trust_facts(const FitProblem& problem, const SearchResult& found);

/// 100 (1 − |x1 − x̂1| / |x1 − mean|) of the free run, worst recording; NaN where it diverges.
double fit_percent(const FitProblem& problem, const std::vector<FitTrace>& traces);

/// Share of what the torque does to the motion that the model leaves unexplained: its prediction error over
/// that of an observer that knows no torque, both less the encoder's floor; above 1 where coasting predicts
/// better.
double unexplained_share(const FitSummary& fit);

/// Fills trust, why and the facts, once everything else in the summary is there. The first reason counts:
///   rejected  the fit failed; it leaves kUnexplained of what the torque does to the motion; the recordings
///             are explained as well without the gap; another gap on another part of them
///   limited   iterations ran out; a gap at its bound or not determined; an input that acts elsewhere than at
///   its
///             row; a free run above the encoder's floor, or within it and not random; values that move by
///             more than their intervals between parts or gains; a number that its bound keeps from a better
///             fit; another law of contact or friction that explains more
///   good      the rest
void judge_trust(const FitProblem& problem, const FitOutcome& outcome, const TrustFacts& facts,
                 FitSummary& summary);

}  // namespace gapscope::internal::reference
