#pragma once

#include <string>

#include "diagnosis/ranking.h"

namespace gapscope::internal::diagnosis {

/// What a reader should know of a candidate before trusting its numbers: that it helps in one measure only,
/// changes next to nothing, or has ended at a bound. Empty if nothing speaks against it.
std::string remark_on(const ScoredModel& candidate, const ScoredModel& before);

}  // namespace gapscope::internal::diagnosis
