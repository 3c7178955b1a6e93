#pragma once

#include "config/configuration.h"

namespace gapscope::internal::config {

/// Estimates the numbers of a model that stands in place of a configuration's own where that one estimates
/// them, within its bounds, from the values that they have; and those of effects that it does not have, as a
/// search would that has added them.
/// @param keep_effects  as they are: some were set
void estimate_as(const Configuration& own, bool keep_effects, ModelConfig& taken);

}  // namespace gapscope::internal::config
