#pragma once

#include <vector>

#include "gapscope/diagnosis/next_experiment.h"

namespace gapscope::internal::diagnosis {

/// Shapes, amplitudes, frequencies, dwells and offsets that a drive can be asked for within its limits.
/// @param peak largest |u|
std::vector<Excitation> experiment_library(const ExperimentLimits& limits, double peak);

/// The same with all of its input a share of what it was.
Excitation scaled(Excitation excitation, double share);

}  // namespace gapscope::internal::diagnosis
