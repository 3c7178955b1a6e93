#pragma once

#include <optional>
#include <vector>

#include "diagnosis/torque_search.h"

namespace gapscope::internal::diagnosis {

/// A step after the first: every candidate on top of what was added before it.
struct FurtherStep {
  ScoredModel before;                   ///< the model so far; its score counts no parameters
  std::vector<ScoredModel> candidates;  ///< best first
  Decision decision;
  std::vector<const EffectEntry*> dropped;  ///< earlier effects that its first candidate made superfluous
};

/// An effect that was added.
struct Addition {
  const EffectEntry* entry = nullptr;
  std::vector<const EffectEntry*> group;  ///< all that it cannot be told from, itself first
};

/// Where half of what was held out was fitted for the later steps.
struct Wider {
  std::vector<MotorTrace> train;
  HeldOut held_out;
  ScoredModel nominal;  ///< by what is still held out
};

/// What the search for several effects came to.
struct Additions {
  bool accepted = false;
  bool explained = false;  ///< what is left on the held-out recordings is the drive's numbers, not an effect
  std::vector<Addition> effects;   ///< those that stay, in the order in which they were found
  ScoredModel after;               ///< with all of them
  std::vector<FurtherStep> steps;  ///< the last one may not have been taken
  std::optional<Wider> wider;
};

/// Goes on where the first step has ended, to the floor or to the last step that the data asks for.
///
/// Forward: every effect of the catalogue on top of the model so far, judged like the first. Backward: an
/// earlier effect without which the later ones do as well was only their stand-in and goes. A first step that
/// is not sure in itself, as half of a cause cannot be, counts once others lead from it to the floor or far
/// towards it.
///
/// A step that begins with what was fitted explained, but not what is held out, asks the recordings that
/// know: the first half of what is held out is then fitted, too.
Additions add_further(const Study& study, const FirstSearch& found);

/// Whether nothing is left to add to them.
bool leaves_nothing(const Additions& additions);

/// The model without any effect, by what the additions are judged by.
const ScoredModel& nominal_of(const FirstSearch& found, const Additions& additions);

/// The effect that was found first, as all steps have left it; where it is in none of their models, as the
/// first step has fitted it alone.
const ModelEffect& first_effect(const FirstSearch& found, const Additions& additions);

/// All steps.
struct EffectSearch {
  FirstSearch found;
  Additions added;
  TorqueSearch ladder;  ///< where it leads: nothing else is added then
};
/// Where they lead nowhere and what is held out shows far more than what was fitted, the first half of it is
/// fitted, too, as in investigate().
EffectSearch search_effects(Study& study);

/// First steps to follow where the best is unsure in itself: those that gain on what is held out, then those
/// that explain most of what was fitted. Where half of the cause is still missing, the numbers of the other
/// half are often so wrong that no held-out recording shows its worth.
std::vector<const ScoredModel*> branches(const FirstSearch& found,
                                         std::size_t most = SearchEffort{}.branches);

/// Whether further steps have shown that an unsure first one was right: they end at the floor, or are clear
/// themselves and leave hardly a part. A first step that is there alone has been decided upon.
bool borne_out(const ScoredModel& nominal, const Additions& additions);

}  // namespace gapscope::internal::diagnosis
