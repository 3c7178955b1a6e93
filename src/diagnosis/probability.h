#pragma once

#include "diagnosis/ranking.h"

namespace gapscope::internal::diagnosis {

/// Probability that the first group of a step holds what is missing, where the catalogue has it in half of
/// all cases: a logistic map of the share of the log distance that it closes, of its margin and of its gain.
/// Learned on drives of the independent plant with one effect, of the catalogue, of none, or taken out of it.
double group_probability(double rel, double margin, double gain);

/// The same of a later step, learned on drives with one and two effects, with what the step could find or
/// without it.
double later_probability(double rel, double margin, double gain);

/// How a step's probability is shared out.
struct Shares {
  std::vector<double> candidates;  ///< in the order of the ranking
  double outside = 1.0;  ///< of the catalogue; all together they make 1, NaN where the model before diverges
};

/// The group shares its probability by the scores, the other candidates what is left to a mistaken order.
/// @param outside how likely the catalogue lacks what is missing before any recording; in (0, 1)
Shares probability_shares(const std::vector<ScoredModel>& ranked, const Decision& decision, double outside);

}  // namespace gapscope::internal::diagnosis
