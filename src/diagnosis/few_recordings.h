#pragma once

#include <span>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::diagnosis {

/// Recordings that stand for all while it is searched what a model lacks, each cut where it is long (see
/// FewRecordings in numbers.h): one after the other the one that differs most from those taken in its load,
/// its controller's gain, its place, travel and speed and its input. All of them where these are few.
std::vector<MotorTrace> few_of(std::span<const MotorTrace> all);

}  // namespace gapscope::internal::diagnosis
