#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/fields.h"
#include "gapscope/reference/fit.h"
#include "gapscope/simulation/excitation.h"

namespace gapscope {

/// `next_experiment:` – what the drive may be asked to do next. An absent limit is that of the recordings.
struct ExperimentLimits {
  std::optional<double> input;    ///< largest |u| [unit of u]
  std::optional<double> travel;   ///< of the motor, peak to peak [rad]
  double lowest_frequency = 0.3;  ///< [Hz]
  double highest_frequency = 10.0;
  double duration = 5.0;  ///< [s]

  void fields(FieldVisitor& visitor);
};

/// A fitted model that explains the recordings about as well as another one, and the effect in which it
/// differs.
struct Rival {
  std::string effect;
  ReferenceModel model;
};

/// How far an input would set one rival apart where the other is the truth.
struct Separation {
  std::string truth, rival;
  double excess = kNaN;  ///< of the refitted rival's innovations over the truth's own, rms [σ of the encoder]
  bool contained = false;  ///< the rival's law contains the truth's: no input can tell
};

struct TriedInput {
  Excitation excitation;
  std::string input;     ///< the same in words
  double travel = kNaN;  ///< of the motor, the larger of the rivals' [rad]
  std::vector<Separation> separations;
  double worst = kNaN;  ///< least excess of the directions that an input can tell [σ]
};

/// What to record next. A default-built one proposes nothing.
struct NextExperiment {
  std::string sentence;                 ///< the following in words; whoever tells it fills it in
  double rate = kNaN, duration = kNaN;  ///< [Hz], [s]
  std::vector<TriedInput> tried;        ///< best first
  std::vector<double> u;                ///< samples of the best one

  bool proposes() const { return !tried.empty(); }
  bool separates() const;  ///< by at least one σ in the worse direction
};

/// The excitation that separates rivals best.
///
/// Sines, sweeps, steps, dwells and one-way travel within the limits are played on each rival in turn, read
/// through the encoder. Every other rival is refitted to what comes out, drive and effect: what counts is
/// what it cannot follow then, in units of the encoder's noise, and of both directions the worse one. The
/// difference without a refit says nothing, since the drive's numbers take most of it up.
/// @param like a recording of the drive: sampling, encoder, and what absent limits are taken from
/// @param progress is told of every input that is tried
/// @throws std::logic_error for fewer than two rivals; Interrupted.
NextExperiment next_experiment(
    std::span<const Rival> rivals, const MotorTrace& like, const ExperimentLimits& limits, double observer_hz,
    int threads = 0, const std::function<void(const std::string&)>& progress = [](const std::string&) {});

/// An input in words: "a sine of 0.5 units of u at 0.3 Hz".
std::string describe(const Excitation& excitation);

}  // namespace gapscope
