#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// The numbers that a step decides by, of one model.
struct ModelEvidence {
  std::string effect;               ///< "": without one
  double score = kInfinity;         ///< S, see diagnose(); infinite where the motion diverges
  double mean_cost = kNaN;          ///< of what was fitted [floor²]
  double median_free = kNaN;        ///< of the restarted free runs [floor]
  double median_innovation = kNaN;  ///< [floor]
  double windows_better = kNaN;     ///< share of the windows above the floor that improve
};

/// What the first step of a diagnosis decided by. It decides again from this alone, as if some effects had
/// been no candidates: no fit is repeated, and none of the others had its start from them taken away.
struct StepEvidence {
  ModelEvidence nominal;
  /// Larger median of the nominal model where it was then fitted to held-out recordings too; else NaN
  /// [floor].
  double alone = kNaN;
  bool repeats_badly = false;             ///< the floor is the drive's repeatability
  std::vector<ModelEvidence> candidates;  ///< best first; empty at the floor
  std::vector<ModelEvidence>
      excluded_parents;  ///< simpler effects that were no candidates, fitted all the same

  /// Larger median of the nominal model fitted to its recordings alone [floor].
  double before() const;
};

/// What a first step comes to. Not accepted, without a group, where there is no candidate.
struct StepOutcome {
  std::vector<std::string> ranking;  ///< best first
  std::vector<std::string> group;    ///< all that the first cannot be told from, itself first
  bool accepted = false;
  double rel = kNaN;          ///< share of the log distance to the floor
  double margin = kNaN;       ///< S of the best outside the group − S of the best
  double gain = kNaN;         ///< S before − S after
  double shrink = kNaN;       ///< of the restarted free runs' median
  double probability = kNaN;  ///< of the group, at even odds of the catalogue
};
StepOutcome decide_again(const StepEvidence& evidence, const std::vector<std::string>& excluded = {});

}  // namespace gapscope
