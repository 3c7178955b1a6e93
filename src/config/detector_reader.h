#pragma once

#include "config/yaml_value.h"
#include "gapscope/config/configuration.h"

namespace gapscope::internal::config {

/// The block `detector:`.
/// @throws ConfigError
DetectorConfig read_detector(const Value& value);

}  // namespace gapscope::internal::config
