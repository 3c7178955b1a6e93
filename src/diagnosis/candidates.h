#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnosis/effect_starts.h"
#include "diagnosis/race.h"

namespace gapscope::internal::diagnosis {

struct Study;

/// Points of the fitted model's parameters with its residuals and their derivatives there: what every
/// candidate's race borrows, since a small effect hardly changes how the drive's own numbers act. They lie at
/// the fitted values and at those of the sheet; the latter is left out where the motion diverges.
std::vector<reference::FitLinearisation> bases_of(const Study& study, const FittedModel& nominal);

/// One effect added to a fitted model: its starts have raced from every base (see Race).
class RacedCandidate {
 public:
  /// @param starts of the effect, in units of its scales; without any, or without a base, nothing is fitted
  ///   and the mean square stays infinite
  /// @param parent a fitted model with the simpler effect that this one contains as its last; may be nullptr
  RacedCandidate(const Study& study, const FittedModel& nominal,
                 std::span<const reference::FitLinearisation> bases, const EffectEntry& entry,
                 std::span<const EffectStart> starts, const FittedModel* parent);

  /// Mean square of the best start after the race, without priors [floor²].
  double raced() const { return race_.least(); }
  /// The best start as it stands.
  FittedModel as_raced() const { return fitted_at(*fit_, race_.leader()); }
  /// @param thorough see Race::refined()
  FittedModel refined(bool thorough = true) const { return fitted_at(*fit_, race_.refined(thorough)); }

 private:
  std::unique_ptr<reference::ModelFit> fit_;
  Race race_;
};

/// A fitted candidate once more, from where a faster observer's fit leads: that forgets sooner what came
/// before, and there are fewer minima to end in.
FittedModel led_by_faster_observer(const Study& study, const FittedModel& candidate);

/// A fitted candidate once more with its effect on the numbers of the drive of a better one, where one of the
/// two effects contains the other's also from its size.
FittedModel on_drive_of(const Study& study, const FittedModel& candidate, const ReferenceModel& better);

/// The same, from where it stands, and on the drive of the sheet, from which numbers that the recordings
/// hardly determine have drifted. Where none of that comes to the floor, also led by a faster observer.
FittedModel retry(const Study& study, const FittedModel& candidate, const ReferenceModel& better);

/// Whether the gap of a free load is sought with no value to begin with.
bool seeks_gap(const ReferenceModel& sheet);

/// A fitted model once more from the given values of the drive, on growing parts of the recordings, with its
/// effects as they were found; whichever leaves less. The numbers that a fit without the effects had led to
/// may lie in another minimum than theirs, and a refinement on all of the recordings not lead from the given
/// ones to it. A gap that the sheet gives no value of is searched for as the first fit did, which did not
/// know of the effects: it may have closed the gap to stand for them.
FittedModel searched_from_sheet(const Study& study, const FittedModel& fitted);

/// Whether the effect is in the model.
bool has_effect(const ReferenceModel& model, const EffectEntry* entry);

/// Whether the effect can be added to this model at all: contact effects need a contact, backlash a drive
/// without, and what the fit estimates anyway cannot be missing.
bool is_candidate(const EffectEntry& entry, const ReferenceModel& model);

/// Whether the effect is a coarser count of the encoder, which no fit of a motion shows.
inline bool reads_counts(const EffectEntry& entry) { return entry.follows == ResidualPattern::kCounts; }

}  // namespace gapscope::internal::diagnosis
