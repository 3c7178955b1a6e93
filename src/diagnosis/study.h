#pragma once

#include <vector>

#include "diagnosis/ranking.h"

namespace gapscope::internal::diagnosis {

/// What all steps of a diagnosis share.
struct Study {
  std::vector<MotorTrace> train;  ///< what is searched on
  HeldOut held_out;
  ReferenceModel sheet;  ///< as given
  std::vector<const EffectEntry*> catalogue;
  double observer_hz =
      kMeasure.slow_hz;       ///< the fast one where unmodelled torque, not the encoder, is the floor
  double seen_quantum = 0.0;  ///< of the samples, where it is coarser than the sheet's; else 0 [rad]
  SearchEffort effort;
  const DiagnosisOptions& options;
  double step_work =
      0.0;  ///< samples of plain runs that the first step, had it tried the whole catalogue, cost
  std::int64_t work_before = 0;      ///< the same, by when the first look, and then further steps, may begin
  ShaftTurns turns = {};             ///< none of a slide
  std::vector<MotorTrace> all = {};  ///< what `train` stands for, where these are more; else empty
  std::vector<std::string> judge_nothing = {};  ///< files too short for a part to be held out: fitted whole

  bool is_exhausted() const;  ///< no further step begins: its work is done, or it was asked to finish
  bool has_done_its_work() const;
  bool is_excluded(const EffectEntry& entry) const;
  /// Whether what the effect would turn with turns at all.
  bool can_turn(const EffectEntry& entry) const;

  bool repeats_badly() const { return held_out.innovation_repeats > 0.0; }
  /// What a step must reach: a drive that repeats itself badly has no floor that a model could come to.
  Reach reach() const { return repeats_badly() ? Reach::kAnyGain : Reach::kFloor; }
};

/// @throws std::logic_error, see diagnose(); ConfigError where no recording is long enough to be judged
Study make_study(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options);

/// The recordings that are fitted, to be judged themselves.
HeldOut fitted_as_held_out(const Study& study);

/// Takes the work since the last first look began as that of a step that has tried so many candidates; none:
/// there is no limit, as nothing follows.
void count_first_step(Study& study, std::size_t candidates);

/// The state that each recording that is fitted begins with, of a model that was fitted to them. A model of
/// the torque balance brings none.
std::vector<reference::RecordingStart> starts_on(const Study& study, const FittedModel& fitted);

/// The study of all recordings that what is searched on stands for, and a model fitted to these.
Study of_all(const Study& study);
ScoredModel on_all(const Study& whole, const ScoredModel& model);

/// What is fitted and what is held out.
std::vector<MotorTrace> everything(const Study& study);

/// Moves the first half of what is held out to what is fitted; once, and where the encoder is the floor.
/// Where the drive rests through one half the halves are of its way, so that no judgement is of a rest.
bool may_fit_half_of_the_held_out(const Study& study);
void fit_half_of_the_held_out(Study& study);

}  // namespace gapscope::internal::diagnosis
