#pragma once

#include <vector>

#include "diagnosis/numbers.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "reference/model_fit.h"

namespace gapscope::internal::diagnosis {

/// What is held out: whole recordings, or the last part of each (the model is run from its beginning then).
struct HeldOut {
  std::vector<MotorTrace> traces;
  std::vector<std::size_t> scored_from;
  std::vector<double> floors;   ///< of the encoder, per recording [rad]
  std::vector<double> periods;  ///< of the input in samples, 0: it does not repeat
  /// Where the drive repeats its motion worse than its encoder reads: how far, for each measure [rad].
  double innovation_repeats = 0.0, free_repeats = 0.0;
  std::string repeats_in;  ///< what that was read from, in words
  /// What a supply that is read in steps leaves open, per recording, for each measure [rad]; empty: nothing.
  std::vector<double> innovation_open = {}, free_open = {};
  /// By which the input of each recording is multiplied at each sample; empty: it is taken as read.
  std::vector<std::vector<double>> input_factors = {};

  /// Samples from one restart to the next, a number that 2 divides; counted in (mean) steps.
  std::size_t restart(std::size_t r) const;
  double innovation_floor(std::size_t r) const;
  /// What the encoder alone leaves of a free run: its own error, and what of it the observer began with.
  double free_encoder_floor(std::size_t r) const;
  double free_floor(std::size_t r) const;
};

/// A model beside one recording.
struct Playback {
  std::vector<double> innovation;  ///< at the gain that the model was fitted with [rad]
  std::vector<double> free;        ///< error of free runs restarted from that observer's state [rad]
  std::vector<double> slow, fast;  ///< innovations at the slow and the fast observer [rad]
  std::vector<double> torque;      ///< correcting torque from the fast ones [N m]
  std::vector<double> ripple;      ///< the same from the ripple observer
  std::vector<double> w1;          ///< of the fast observer [rad/s]
  std::vector<Mode> mode;
};

/// Mean squares over windows, in floors squared, all recordings one after the other.
struct Windows {
  std::vector<double> innovation;  ///< half a restart long
  std::vector<double> free;        ///< a restart long
  std::vector<double> slow, fast;  ///< half a restart long, in floors of the encoder squared
  std::vector<double> torque;      ///< the same [(N m)²]
};

/// Every number given, nothing estimated.
ReferenceModel all_fixed(ReferenceModel model);

/// Initial states of recordings that suit a model whose numbers are all known.
std::vector<reference::RecordingStart> settled_starts(std::span<const MotorTrace> recordings,
                                                      const ReferenceModel& model, double observer_hz);

/// What the simulator takes a model for whose numbers are all known.
/// @param like recordings that its scales are taken from
PlantModel<double> stepper_of(const ReferenceModel& model, std::span<const MotorTrace> like);

/// Plays a model on what is held out, the load's initial position fitted. Empty if the motion diverges.
/// @param all false: only what the score needs, innovations and free runs
std::vector<Playback> play(const ReferenceModel& model, const HeldOut& held_out, double observer_hz,
                           bool all);

/// The same from given initial states.
std::vector<Playback> play_from(const std::vector<reference::RecordingStart>& from,
                                const ReferenceModel& model, const HeldOut& held_out, double observer_hz,
                                bool all);

/// A position for each sample of each recording [rad]. Empty: a motion diverges.
using Positions = std::vector<std::vector<double>>;

/// What the encoder would read of the model that runs freely from the first sample of each recording on,
/// never restarted.
Positions whole_runs(const ReferenceModel& model, const HeldOut& held_out, double observer_hz);

/// The same of what is judged alone, from where the observer has brought the model by then.
Positions judged_runs(const ReferenceModel& model, const HeldOut& held_out, double observer_hz);

Windows windows_of(const std::vector<Playback>& playbacks, const HeldOut& held_out);

/// The windows of the free runs for a drive that stands still: x1 about its mean [free_floor²].
std::vector<double> still_windows(const HeldOut& held_out);

/// Mean of log(W + the offset of the score).
double mean_log(const std::vector<double>& mean_squares);

/// ½ of it over the innovations + ½ over the free runs; infinite where the motion diverged.
double log_score(const Windows& windows);

/// √ of the median of mean squares.
double median_size(const std::vector<double>& mean_squares);

}  // namespace gapscope::internal::diagnosis
