#pragma once

#include "config/configuration.h"
#include "config/schema_parts.h"
#include "config/yaml_value.h"
#include "config/yaml_writer.h"

namespace gapscope::internal::config {

/// `anchor:`, beside the model that it fixes the scale of.
/// @throws ConfigError where the model says the same or has no place for it
void read_anchor(const Section& root, Configuration& configuration);

void write_anchor(YamlWriter& out, const AnchorConfig& anchor);

Json anchor_schema();

}  // namespace gapscope::internal::config
