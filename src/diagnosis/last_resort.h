#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/ranking.h"
#include "diagnosis/study.h"
#include "diagnosis/told_facts.h"
#include "gapscope/diagnosis/last_resort.h"

namespace gapscope::internal::diagnosis {

/// A law of last resort that a model lacks.
struct LawSearch {
  ScoredModel before;  ///< the model that it was added to; its score counts no parameters
  ScoredModel after;
  std::vector<const EffectEntry*> group;  ///< with it: laws of other variables that do nearly as well
  /// Where it explains what was fitted, but far less of what was held out: with the first half of that
  /// fitted, too. The second half judges.
  std::shared_ptr<const Study> wider;
};

/// Every law of last resort on top of a model, with as few nodes or harmonics as what is held out asks for,
/// refitted by the simulator and judged like an effect. Nothing where the model is at the floor or no law
/// shrinks the held-out error as a step must.
/// @param drive_known  the torque balance has found the model's drive: laws race on it alone, and the best is
///   refined, since far above the floor none explains all that was fitted
std::optional<LawSearch> search_last_resort(const Study& study, const ScoredModel& model,
                                            bool drive_known = false);

/// What a law has ahead of a model.
struct Lead {
  /// S, all that was estimated of effects and laws counted, by what judges the law.
  double score = -kInfinity;
  bool was_asked_for = false;  ///< it leaves less of what was fitted, too: ahead on the rest alone is luck

  bool is_clear() const { return was_asked_for && score > kRule.tells_apart; }
};
Lead lead_over(const LawSearch& law, const ScoredModel& model);

/// Whether a law is the series that an effect begins: of the same torque, on the same axis, over the
/// position, by its period or an integer fraction of it. Then it says of the effect's shape what its own
/// form leaves out, and nothing against it.
bool is_series_of(const LawSearch& law, const ModelEffect& effect);

/// As the report tells it.
LastResortLaw told(const Study& study, const LawSearch& found);

}  // namespace gapscope::internal::diagnosis
