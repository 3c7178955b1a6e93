#pragma once

#include <vector>

#include "commands/text_files.h"
#include "report/figure_formats.h"
#include "results/report_folder.h"
#include "run/run_pipeline.h"

namespace gapscope {

/// `run`, `detect` and `fit` but for the writing: run_pipeline() of files that stay as they are meanwhile.
/// @throws ConfigError, Interrupted
RunOutcome make_estimate(const Configuration& configuration, const Estimators& wanted,
                         const Progress& progress);

/// resolved.yaml and, where there is a fit that `simulate` can run, fitted.yaml.
/// @param result  with its recordings
std::vector<TextFile> estimate_texts(const Configuration& configuration, const RunResult& result);

/// Writes the whole report and commits it. A diagnosis that is there and goes with it stays, with a
/// fitted.yaml of its own; one that does not is dropped, which is one more warning. The samples of the
/// outcome are gone then.
/// @throws ConfigError, Interrupted, std::runtime_error for what cannot be written
void write_estimate(ReportFolder& report, const Configuration& configuration, const FigureFormats& figures,
                    RunOutcome& outcome);

}  // namespace gapscope
