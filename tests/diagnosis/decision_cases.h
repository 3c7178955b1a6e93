#pragma once

#include <string>
#include <vector>

#include "diagnosis/ranking.h"

namespace gapscope::test {

/// What the search of a case has fitted, before anything was decided: rules are compared on it without
/// fitting again.
struct DecisionCase {
  std::uint64_t seed = 0;
  std::string kind, rig, effect;
  double severity = 0.0, seconds = 0.0;
  internal::diagnosis::ScoredModel before;                   ///< by its windows and its fit alone
  std::vector<internal::diagnosis::ScoredModel> candidates;  ///< the same; none where nothing seemed missing
  bool lacks_nothing() const { return effect == "none"; }
};

/// One case as lines of text, and all cases of a file in the order of their seeds.
std::string text_of(const DecisionCase& c);
std::vector<DecisionCase> read_decision_cases(const std::string& file);

}  // namespace gapscope::test
