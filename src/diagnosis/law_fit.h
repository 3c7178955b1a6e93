#pragma once

#include <array>
#include <vector>

#include "diagnosis/counted.h"
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

/// Work that the free-form laws over a model may take: as much as a whole first step has. Beyond it none is
/// refined any further; all have raced.
class LawWork {
 public:
  explicit LawWork(const Study& study);

  bool is_done() const;

 private:
  const Study* study_;
  std::int64_t begun_;  ///< samples of plain runs by then
};

/// Parameters of an effect, or a law, that are estimated.
double estimated_in(const ModelEffect& effect);

/// A fitted law by what is held out. Of its parameters those count that are estimated.
ScoredModel judged(const Study& study, const EffectEntry& law, FittedModel fitted);

bool costs_less(const FittedModel& a, const FittedModel& b);

/// A fitted model once more, from where it stands.
FittedModel fit_from(const Study& study, const FittedModel& from, const reference::RefineEffort& effort);

/// A law over a model: its levels, each as far as it has been fitted.
class LawFit {
 public:
  LawFit(const Study& study, const LawWork& work, const ScoredModel& before, const LawVariant& variant);

  void tell(Counted& counted) const;

  /// The level that leaves least of what was fitted.
  const FittedModel& closest() const;

  /// Every level on the numbers of a drive: without the law, and with that of the level before.
  void race_on(const ReferenceModel& drive);

  /// Level by level on the model's own drive, as long as what is held out asks for more.
  void climb();

  /// Level by level to the end, until one explains what was fitted or the work is done.
  void refine();

  /// With as many parameters as what is held out asks for.
  ScoredModel best() const;

 private:
  void settle(FittedModel& here) const;
  FittedModel quickly(FittedModel from, std::size_t level) const;

  const Study* study_;
  const LawWork* work_;
  LawVariant variant_;
  FittedModel origin_;               ///< the model without the law
  std::vector<FittedModel> fitted_;  ///< of each level
};

}  // namespace gapscope::internal::diagnosis
