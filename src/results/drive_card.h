#pragma once

#include <string>

#include "gapscope/telling/card.h"
#include "results/diagnosis_result.h"
#include "results/run_result.h"

namespace gapscope {

/// The card of what a folder holds: an estimate, a diagnosis or both of one drive.
/// @param run, diagnosis  nullptr: not there
Card drive_card(const RunResult* run, const DiagnosisResult* diagnosis);

/// Gives an estimate its card, with that of the diagnosis in the same folder where there is one.
/// @throws ConfigError where that cannot be read.
void add_card(const std::string& folder, RunResult& run);

/// Gives either its own, as in a folder without the other.
void add_card(RunResult& run);
void add_card(DiagnosisResult& diagnosis);

/// Gives a diagnosis its answer: the gap is that of the estimate in the same folder, where there is one.
void add_card(const std::string& folder, DiagnosisResult& diagnosis);

}  // namespace gapscope
