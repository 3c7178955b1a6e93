#pragma once

#include <string>
#include <vector>

#include "commands/text_files.h"
#include "report/figure_formats.h"
#include "results/report_folder.h"
#include "run/run_diagnosis.h"

namespace gapscope {

/// Adds to the effects that are no candidates.
/// @throws ConfigError for one that the catalogue does not have
void exclude_effects(const std::vector<std::string>& effects, Configuration& configuration);

/// Puts what a user's simulator answered in the place of `recording: simulated:`.
/// @param files  relative to the current folder; none: the configuration stays
/// @throws ConfigError where it has no recording, or another number of them
void take_simulated(const std::vector<std::string>& files, Configuration& configuration);

/// Everything beside diagnosis.json and the traces: resolved.yaml, fitted.yaml; the table of each law of last
/// resort and the model with it; the experiment that would decide, where one is proposed.
/// @param fitted  the recording that was fitted
std::vector<TextFile> diagnosis_texts(const Configuration& configuration, const DiagnosisResult& result,
                                      const MotorTrace& fitted);

/// Writes the whole report and commits it. An estimate that is there and goes with it stays; one that does
/// not is dropped, which is one more warning of the diagnosis.
/// @param more  files that go with it
/// @throws ConfigError, Interrupted, std::runtime_error for what cannot be written
void write_diagnosis(ReportFolder& report, const Configuration& configuration, const FigureFormats& figures,
                     DiagnosisOutcome& outcome, const std::vector<TextFile>& more = {});

}  // namespace gapscope
