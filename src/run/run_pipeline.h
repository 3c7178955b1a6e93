#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/configuration.h"
#include "results/run_result.h"

namespace gapscope {

/// Whether a file is a recording as `simulate` writes it, with the mode of the coupling, which no encoder
/// tells.
bool is_made_by_simulate(const std::string& path);

/// Which of the estimators a command asks for.
struct Estimators {
  bool model_free = true;
  bool reference = true;
  bool literal = true;           ///< where `detector: literal:` gives it a bound
  bool reading_is_kept = false;  ///< where the reference is interrupted and the other has ended
};

/// Told what begins: "reading train.csv".
using Progress = std::function<void(const std::string&)>;

struct RunOutcome {
  RunResult result;
  Timing timing;
  std::vector<std::string> warnings;  ///< what the user should know beside the result
  bool stopped = false;               ///< the reference was interrupted, and the rest kept
};

/// Data, both estimators, comparison: everything of `run`, `detect` and `fit` but the writing. Uneven rows
/// need a resampling for the detector; the reference takes them as they are where that is for the detector
/// alone.
/// @param threads  from two on the estimators work side by side; 0: as many as there are cores
/// @throws ConfigError, Interrupted
RunOutcome run_pipeline(const Configuration& configuration, const Estimators& wanted,
                        const Progress& progress, int threads = 1);

struct LoadedRecordings {
  std::vector<Recording> recordings;
  std::vector<std::string> notes;     ///< what was done to them
  std::vector<std::string> warnings;  ///< what looks wrong

  std::vector<MotorTrace> motor_traces() const;
};

/// The recordings of a configuration, read or simulated, with the encoder's sheet applied.
/// @param uneven  for whom: the detector needs a grid, fit and diagnosis take uneven rows as they are
/// @throws ConfigError, Interrupted
LoadedRecordings load_recordings(const Configuration& configuration, UnevenRows uneven,
                                 const Progress& progress);

/// The recordings of `held_out:`, read as a diagnosis takes them; empty where there are none.
LoadedRecordings load_held_out(const Configuration& configuration, const Progress& progress);

/// What a result will be made from, each with its SHA-256: of the resolved configuration what an estimate and
/// a diagnosis both rest on, the recordings that it names, those held out, the input that a simulation plays
/// again.
std::vector<FileHash> sources_of(const Configuration& configuration);

/// The paths of the configuration itself and of these files.
std::vector<std::string> source_paths(const Configuration& configuration);

/// @throws ConfigError where these, as sources_of() gave them before they were read, are others now
void require_unchanged(const Configuration& configuration, const std::vector<FileHash>& sources);

/// The recording that `simulation:` describes.
Recording simulated_recording(const Configuration& configuration);

}  // namespace gapscope
