#pragma once

#include <span>

#include "config/configuration.h"
#include "gapscope/recording/recording.h"

namespace gapscope::internal::run {

/// One motion is one piece of evidence, under however many names and in however many windows: counted twice
/// it halves intervals, and held out it judges a model by what was fitted.
/// @throws ConfigError where one of `others` has rows of a recording before it or of `first`: the same t, or
/// the same time since the first row, u and position
void require_own_rows(const Configuration& configuration, std::span<const Recording> first,
                      std::span<const Recording> others);

}  // namespace gapscope::internal::run
