#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/candidates.h"

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

ScoredModel judge(const EffectEntry* entry, FittedModel fitted, const HeldOut& held_out, double observer_hz);

/// Whether the table of the catalogue names one as a look-alike of the other.
bool look_alike(const EffectEntry& a, const EffectEntry& b);

inline constexpr double kFloorRatio = 1.3;  ///< medians within it: at the floor
/// Mean square [floor²] up to which a fit may have ended in a minimum beside the best one.
inline constexpr double kNearFloor = 4.0;
inline constexpr double kExplained = kFloorRatio * kFloorRatio;  ///< mean square of a fit [floor²]

/// Both medians within 1.3 floors.
bool at_floor(const ScoredModel& judged);

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

/// Best first: by score; a nested parent goes before its child unless the child gains much more.
/// @param repeats_badly the floor is the drive's repeatability: no child is right to the floor, so a parent
///   that takes most of the error goes first and the rest is left to a further step
void rank(std::vector<ScoredModel>& candidates, const ScoredModel& before, bool repeats_badly);

/// Whether the first candidate is what is missing. A step is taken that closes much of the log distance to
/// the floor and stands clear of all others; or, where no model can reach the floor, one that gains clearly
/// and nearly everywhere and stands clear.
/// @param excluded_parents simpler effects that are no candidates, fitted all the same: a child that does no
///   better than its parent alone is the parent under another name, and is not accepted
Decision decide(const std::vector<ScoredModel>& ranked, const ScoredModel& before, bool repeats_badly,
                std::span<const ScoredModel> excluded_parents);

/// The same of an effect that is to be all that is missing. A law that is fixed but for its size leaves
/// nothing where it is the cause: where it leaves more than a trace, it is at best a part.
Decision decide_alone(const std::vector<ScoredModel>& ranked, const ScoredModel& before, bool repeats_badly,
                      std::span<const ScoredModel> excluded_parents);

/// Whether a candidate shrinks the held-out error beyond chance and by what is worth having, whatever its
/// cause: by at least a tenth of the mean square, of which the 95 % interval over windows is above zero, in
/// most of them, and asked for by what was fitted.
bool helps(const ScoredModel& before, const ScoredModel& after, bool repeats_badly);

double relative_gain(const ScoredModel& before, const ScoredModel& after);
/// Of the free runs above the floor; of the innovations where none is.
double share_of_windows_better(const ScoredModel& before, const ScoredModel& after);

}  // namespace gapscope::internal::diagnosis
