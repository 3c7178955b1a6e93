#pragma once

#include <string>
#include <vector>

#include "run/run_pipeline.h"

namespace gapscope::internal::run {

/// The configuration with `controller: rate: auto` settled: at the rows or between them, whichever leaves
/// less of the motion of the first recordings, in a fit of the model as it is. Where neither does, at the
/// rows.
/// @param said  gets what was chosen, where it matters
Configuration with_settled_rate(const Configuration& configuration, const Progress& progress,
                                std::vector<std::string>& said);

}  // namespace gapscope::internal::run
