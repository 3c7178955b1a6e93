#pragma once

#include <optional>

#include "results/diagnosis_result.h"
#include "run/run_pipeline.h"

namespace gapscope {

/// What a diagnosis is made from.
struct DiagnosisRecordings {
  LoadedRecordings train, held_out;
  std::optional<DriveController> controller = {};  ///< that made the inputs
  std::optional<ControllerModel> sought =
      {};  ///< controller that each step estimates anew; none: it is known
};

/// Reads what is fitted and what is held out.  @throws ConfigError, Interrupted
DiagnosisRecordings load_for_diagnosis(const Configuration& configuration, const Progress& progress);

/// The diagnosis of recordings that are there, and nothing else.
/// @throws ConfigError where the model cannot be fitted or nothing moves, Interrupted
Diagnosis diagnose_recordings(const Configuration& configuration, const DiagnosisRecordings& recordings,
                              const DiagnosisOptions& options);

struct DiagnosisOutcome {
  DiagnosisResult result;
  Recording first;  ///< of what was fitted
};

/// Everything of `diagnose` but the writing: the recordings are read, looked at as `check` does and
/// diagnosed; where they do not decide, the experiment that would is looked for. The answer of the user's
/// simulator is laid beside them where the configuration names it.
/// @param told_before  told the warning that is worth reading before the work begins: the recordings would
///                     do better the other way round; it stands among the result's, too
/// @throws ConfigError, also where a source changes meanwhile; Interrupted
DiagnosisOutcome run_diagnosis(
    const Configuration& configuration, const DiagnosisOptions& options,
    const Progress& told_before = [](const std::string&) {});

}  // namespace gapscope
