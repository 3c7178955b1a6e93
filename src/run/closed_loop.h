#pragma once

#include <optional>
#include <vector>

#include "run/run_diagnosis.h"

namespace gapscope::internal::run {

/// The longest part of each recording in which its controller was at work; of others the whole.
/// @param too_short  is told the files of which that part has fewer than kFewestSamples: they are left out
std::vector<Recording> switched_on(const std::vector<Recording>& recordings,
                                   std::vector<std::string>& too_short);

std::vector<MotorTrace> traces_of(const std::vector<Recording>& recordings);

/// The drive in its loop, where its controller made the inputs; else nothing.
std::optional<LoopFit> fitted_loop(const Configuration& configuration, const DiagnosisRecordings& recordings,
                                   const DiagnosisOptions& options);

/// Whether its controller has a law beside the declared one that explains much of the loop's error: what it
/// makes of the targets is another input.
bool has_another_law(const LoopFit& loop);

/// Gives the diagnosis the whole held-out recordings beside the drive in its loop: beside the loop's own fit
/// where that follows them nearer than the model that the diagnosis has come to, else beside this. Where
/// nothing is held out what was fitted stands for it.
void tell_closed_loop(const DiagnosisRecordings& recordings, const std::optional<LoopFit>& loop,
                      Diagnosis& diagnosis);

}  // namespace gapscope::internal::run
