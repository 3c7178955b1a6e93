#pragma once

#include <vector>

#include "blind/score.h"

namespace gapscope::blind {

/// A label beside its answer.
struct ScoredAnswer {
  const BlindLabel* label = nullptr;
  const BlindAnswer* answer = nullptr;
  StepOutcome first;  ///< step

  bool none() const { return label->effects.empty(); }
  bool pair() const { return label->effects.size() > 1; }
  bool outside() const;  ///< an effect that the catalogue does not have
  bool known() const { return label->effects.size() == 1 && !outside(); }
  bool reported() const { return label->part == "report"; }
  bool seen() const { return answer->evidence.before() > 2.0; }
  bool in_group() const;         ///< one of the truths is in the first step's group
  bool claims_no_cause() const;  ///< unknown, or an effect that helps while its cause is open
  bool blamed() const { return answer->verdict == "effect"; }
  bool holds(const std::string& effect) const;  ///< it is among those named, or in the first one's group
  bool named() const { return blamed() && holds(label->effects.front()); }
  bool wrong() const { return blamed() && !holds(label->effects.front()); }
  bool right() const;  ///< all truths and nothing else; unknown where the truth is outside the catalogue
  std::size_t found() const;  ///< how many of the truths are named
  /// How many effects the final model has: one whose law a later one contains, as Stribeck friction contains
  /// Coulomb's, has given it its place.
  std::size_t standing() const;
  std::size_t place() const;  ///< of the truth in the ranking, 0 is first
  bool told() const;          ///< an implant was added, or is in the group of one that was
  /// An effect was called the cause that was neither implanted nor is the drive's own, nor what contains the
  /// one or is contained in the other.
  bool stranger() const;
  bool as_undisturbed() const;  ///< the effects are those of the recordings without an implant
};

std::vector<ScoredAnswer> scored(const BlindLabels& labels, const BlindAnswers& answers);

/// The truth and, if asked for, its look-alikes.
std::vector<std::string> truth_of(const ScoredAnswer& c, bool and_look_alikes);

/// All counts of the report part.
std::vector<BlindCount> count_answers(const std::vector<ScoredAnswer>& cases);

/// The same of implants.
std::vector<BlindCount> count_implants(const std::vector<ScoredAnswer>& cases);

/// Per rig, severity and effect.
std::vector<BlindSlice> slice_answers(const std::vector<ScoredAnswer>& cases);

/// A decision of a first step and whether its group holds the truth.
struct Judgement {
  StepOutcome outcome;
  bool right = false;
};

/// Of all cases of a part with at most one effect, and of those with a known one once more without the truth
/// and its look-alikes.
std::vector<Judgement> judgements(const std::vector<ScoredAnswer>& cases, const std::string& part);

/// @param learn, judge  decisions of the calibration and the report part
BlindCalibration calibrate(const std::vector<Judgement>& learn, const std::vector<Judgement>& judge);
double probability_of(const StepOutcome& outcome, const BlindCalibration& calibration);
std::vector<AbstentionPoint> abstention_of(const std::vector<Judgement>& judge,
                                           const BlindCalibration& calibration);

}  // namespace gapscope::blind
