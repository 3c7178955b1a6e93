#pragma once

#include <vector>

#include "changes/drive_report.h"
#include "gapscope/recording/recording.h"

namespace gapscope::internal::changes {

/// Friction and stiffness of the loops that a lost motion was read from, level by level.
std::vector<LoopFacts> loop_facts(const LostMotion& lost_motion, const std::vector<Recording>& recordings);

}  // namespace gapscope::internal::changes
