#pragma once

#include <vector>

#include "diagnosis/ranking.h"

namespace gapscope::internal::diagnosis {

/// What all steps of a diagnosis share.
struct Study {
  std::vector<MotorTrace> train;
  HeldOut held_out;
  ReferenceModel sheet;  ///< as given
  std::vector<const EffectEntry*> catalogue;
  double observer_hz = kSlowHz;  ///< kFastHz where unmodelled torque, not the encoder, is the floor
  double seen_quantum = 0.0;     ///< of the samples, where it is coarser than the sheet's; else 0 [rad]
  const DiagnosisOptions& options;

  bool repeats_badly() const { return held_out.innovation_repeats > 0.0; }
};

/// @throws std::logic_error, see diagnose().
Study make_study(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options);

/// The recordings that are fitted, to be judged themselves.
HeldOut fitted_as_held_out(const Study& study);

/// What is fitted and what is held out.
std::vector<MotorTrace> everything(const Study& study);

/// Moves the first half of what is held out to what is fitted; once, and where the encoder is the floor.
bool may_fit_half_of_the_held_out(const Study& study);
void fit_half_of_the_held_out(Study& study);

/// Every effect of a list that the model could have, refitted and judged, best first.
/// @param first_step false: candidates that have lost clearly are not tried again
std::vector<Judged> candidates_of(const Study& study, const Judged& before,
                                  const std::vector<const EffectEntry*>& catalogue, bool first_step = true);

/// The model beside what it was fitted to, see play().
std::vector<Playback> play_on_train(const Study& study, const FittedModel& model);

/// What the steps came to.
struct Findings {
  Judged before;
  double alone =
      kNaN;  ///< held-out size without any held-out recording in the fit, where they are in it [floor]
  std::vector<Judged> candidates;        ///< best first; empty at the floor
  std::vector<Judged> excluded_parents;  ///< of the first candidate
  Decision decision;
};
/// A drive that repeats its own motion far worse than its encoder reads cannot be explained to the encoder's
/// floor by any model: the study goes on with its repeatability as the floor and a faster observer.
///
/// Where the fitted recordings are explained and the others are not, they ask too little: the first half of
/// what is held out is then fitted with them, and only the second half judges.
Findings investigate(Study& study);

}  // namespace gapscope::internal::diagnosis
