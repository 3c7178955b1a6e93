#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_facts.h"
#include "gapscope/base/coordinates.h"
#include "gapscope/base/statistics.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "telling/answer.h"

namespace gapscope {

/// With what a recording was made, as far as its columns tell.
struct ExcitationFacts {
  std::string file;
  int samples = 0;
  double rate = kNaN;             ///< [Hz]
  double quantum = kNaN;          ///< of the encoder [rad]; 0: unknown
  double input_rms = kNaN;        ///< [unit of u]
  double input_peak = kNaN;       ///< that 1 % of the samples exceed [unit of u]
  double input_frequency = kNaN;  ///< half the rate at which u crosses its mean, with hysteresis [Hz]
  double position_rms = kNaN;     ///< [rad]
};

/// A mean over the branches of a loop.
struct LoopMean {
  double value = kNaN;
  double half_width = kNaN;  ///< of its 95 % interval, from the scatter of the branches
};

/// What the quasi-static loop of x1 over u has at one torque level beside its width at zero torque.
struct LoopFacts {
  double amplitude = kNaN;  ///< that of the level [unit of u]
  LoopMean friction;        ///< area over twice the travel: what reverses with the motion [unit of u]
  LoopMean stiffness;       ///< of the flank, from 0.6 to 0.95 of the amplitude [unit of u per rad]
  bool runs_free = false;   ///< over most of the lost motion; else the friction is that at least
  std::vector<double> u = {}, x1 = {};  ///< mean loop, closed, x1 about its middle [unit of u, rad]
};

/// What one folder of `run`, `detect`, `fit` or `diagnose` says of a drive; a part that was not asked for is
/// absent.
struct DriveReport {
  std::string folder;
  std::string name;           ///< of the configuration
  std::string version;        ///< of gapscope
  std::string configuration;  ///< resolved; empty in files that were written before it was stored
  Coordinates coordinates;    ///< of a translation: rad and N·m mean m and N
  std::optional<GapEstimate> model_free;
  std::optional<FitSummary> reference;  ///< without its traces
  std::vector<ExcitationFacts> recordings;
  std::vector<std::string> doubts = {};     ///< what is stored is not what gapscope wrote, as sentences
  std::optional<Answer> answer = {};        ///< that of the diagnosis where there is one
  std::optional<Diagnosis> diagnosis = {};  ///< without its traces
  std::optional<InputFacts> input = {};     ///< absent where nothing is known of it
  std::vector<LoopFacts> loops = {};        ///< by torque level, as `model_free` has them
};

/// @throws ConfigError with file, what is wrong and what was expected, where there is no result or a damaged
/// one
DriveReport read_drive_report(const std::string& folder);

}  // namespace gapscope
