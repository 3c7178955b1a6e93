#pragma once

#include <vector>

#include "diagnosis/ranking.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// How far a law goes: which of its parameters are estimated.
struct LawLevel {
  std::size_t first = 1, last = 0;  ///< those of [first, last]
  bool period = false;              ///< and the first one
};

/// A law and the abscissa that it begins with.
struct LawVariant {
  const EffectEntry* entry = nullptr;
  double abscissa = kNaN;        ///< peak speed, peak input or period
  std::vector<LawLevel> levels;  ///< each contains the one before
};

/// Every law of last resort that is no excluded one, position torque with each period that comes into
/// question.
/// @param model  that they are laid over
std::vector<LawVariant> law_variants(const Study& study, const ScoredModel& model);

}  // namespace gapscope::internal::diagnosis
