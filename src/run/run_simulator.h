#pragma once

#include <string>
#include <vector>

#include "run/run_diagnosis.h"

namespace gapscope::internal::run {

/// What the user's simulator answers to what was recorded.
struct SimulatedRecordings {
  LoadedRecordings train, held_out;  ///< each as long as the drive's; nothing held out: none was given
  std::vector<FileHash> files;
  std::vector<std::string> warnings;

  bool empty() const { return train.recordings.empty(); }
};

/// Reads `recording: simulated:`, each as the drive's encoder would have read it.
/// @throws ConfigError, also where it is the answer to another input; Interrupted
SimulatedRecordings load_simulated(const Configuration& configuration, const DiagnosisRecordings& recordings,
                                   const Progress& progress);

/// Diagnoses the simulator with the model that the drive was diagnosed with, and lays both side by side.
SimulatorComparison compare_simulated(const Configuration& configuration,
                                      const DiagnosisRecordings& recordings,
                                      const SimulatedRecordings& simulated, const Diagnosis& drive,
                                      const DiagnosisOptions& options);

}  // namespace gapscope::internal::run
