#pragma once

#include "config/schema_parts.h"
#include "config/yaml_value.h"
#include "config/yaml_writer.h"
#include "gapscope/config/configuration.h"

namespace gapscope::internal::config {

/// `controller: {position: {...}, velocity: {...}}`, which goes with `recording: columns: target:`.
/// @throws ConfigError where one of the two stands alone
void read_controller(const Section& root, Configuration& configuration);

void write_controller(YamlWriter& out, const ControllerModel& model);

Json controller_schema();

}  // namespace gapscope::internal::config
