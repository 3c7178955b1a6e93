#pragma once

#include <array>
#include <vector>

#include "diagnosis/ranking.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Shares of the largest speed over which the nodes of a friction lie, all of it and closer: what bends at
/// low speed bends within a piece or two of the former. Of seeds 1410011 and 1410037 (study_diagnosis, law)
/// the first asks for the former (8.4 floors of 831 left of what was fitted; 100 with the latter), the second
/// for the latter (2.2 of 111; 32).
inline constexpr std::array kSpeedShares{1.0, 0.4};

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
