#pragma once

#include "config/configuration.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// The block `detector:`.
/// @throws ConfigError
DetectorConfig read_detector(const Value& value);

}  // namespace gapscope::internal::config
