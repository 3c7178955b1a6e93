#pragma once

#include <span>
#include <string>
#include <vector>

#include "diagnosis/candidates.h"
#include "diagnosis/rule.h"

namespace gapscope::internal::diagnosis {

/// A fitted model with what it does on held-out data.
struct ScoredModel {
  const EffectEntry* entry = nullptr;  ///< the last effect; nullptr: the model before
  FittedModel fitted;
  Windows windows;
  double score = kInfinity;   ///< S, extra parameters included
  double median_free = kNaN;  ///< [floor]
  double median_innovation = kNaN;
  double windows_better = kNaN;  ///< of a model known by its numbers alone, without windows
};

/// What the windows of a model with this as its last effect come to.
ScoredModel scored_by_windows(const EffectEntry* entry, Windows windows);
ScoredModel judge(const EffectEntry* entry, FittedModel fitted, const HeldOut& held_out, double observer_hz);

/// Whether the table of the catalogue names one as a look-alike of the other.
bool look_alike(const EffectEntry& a, const EffectEntry& b);

/// Both medians within kRule.floor_ratio.
bool at_floor(const ScoredModel& judged);
/// Whether a model that adds to another predicts what is held out to the floor, as the other does not, and
/// departs farther in free runs all the same: then these say nothing against it. Detents that take most of
/// the motor's energy make as much of a count at the start of a run; a model without them cannot.
bool is_led_astray(const ScoredModel& added, const ScoredModel& other);

/// Whether a model leaves far more of what is held out than the mean square that was left of what was fitted.
bool leaves_far_more_held_out(const ScoredModel& model, double fitted_mean_cost);

/// How sure a step is.
struct Decision {
  bool accepted = false;
  bool in_part = false;  ///< all speaks for it but what it leaves: not accepted unless a further step is
  std::vector<const EffectEntry*> group;  ///< all that the first cannot be told from, itself first
  double rel = kNaN;                      ///< share of the log distance to the floor
  double gain = kNaN;                     ///< S before − S after
  double margin = kNaN;                   ///< S of the best outside the group − S of the best
  double windows_better = kNaN;           ///< of those above the floor
  double probability = kNaN;  ///< that the group holds what is missing, at even odds of the catalogue
};

/// Best first: by score; an effect that the first one contains goes before it where the data does not tell
/// them apart.
void rank(std::vector<ScoredModel>& candidates, const DecisionRule& rule = kRule);

/// What a step must reach.
enum class Reach {
  kFloor,    ///< it is to be what is missing: it goes much of the way to the floor
  kAnyGain,  ///< the floor is out of reach for it: it gains clearly, in most windows
};

/// Whether the first candidate is what is missing: it leads all others that it can be told from, what was
/// fitted asks for it, and it reaches what it must.
/// @param excluded_parents simpler effects that are no candidates, fitted all the same: a child that does no
///   better than its parent alone is the parent under another name, and is not accepted
Decision decide(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                std::span<const ScoredModel> excluded_parents, const DecisionRule& rule = kRule);

/// The same of an effect that is to be all that is missing. Where it leaves more than a part
/// it is at best one of several.
Decision decide_alone(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                      std::span<const ScoredModel> excluded_parents, const DecisionRule& rule = kRule);

/// The same where a torque balance stands beside the refits, and would answer if these did not. Those that
/// reach the floor and do not differ by `tells_apart` are one group: what is missing is among them.
Decision decide_among_equals(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                             std::span<const ScoredModel> excluded_parents, const DecisionRule& rule = kRule);

/// Whether a candidate shrinks the held-out error beyond chance and by what is worth having, whatever its
/// cause: by at least a part of the mean square, of which the 95 % interval over windows is above zero, in
/// most of them, and by the same part of what was fitted. Where it has ended at none of its effect, other
/// numbers do.
bool helps(const ScoredModel& before, const ScoredModel& after, bool repeats_badly);

double relative_gain(const ScoredModel& before, const ScoredModel& after);
/// Of the free runs above the floor; of the innovations where none is.
double share_of_windows_better(const ScoredModel& before, const ScoredModel& after);

/// What a reader should know of a candidate before trusting its numbers: that it helps in one measure only,
/// changes next to nothing, or has ended at a bound. Empty if nothing speaks against it.
std::string remark_on(const ScoredModel& candidate, const ScoredModel& before);

}  // namespace gapscope::internal::diagnosis
