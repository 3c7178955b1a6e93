#pragma once

#include <cstdint>
#include <vector>

#include "config/blind_config.h"
#include "results/blind_records.h"

namespace gapscope::blind {

struct PlannedCase {
  BlindLabel label;
  std::uint64_t seed = 0;
};

/// All cases of a check in the order of their neutral names. Effects and rigs take turns within each part;
/// severity, salt, the second effect of a pair and the order are drawn from the seeds.
std::vector<PlannedCase> plan_cases(const BlindConfig& config);

}  // namespace gapscope::blind
