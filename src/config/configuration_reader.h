#pragma once

#include "config/configuration.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// `name:`, or what the file is called: fit to name a folder.  @throws ConfigError
std::string read_name(const Section& root, const std::string& file);

/// The configuration in a document, or in a part of one.  @throws ConfigError
Configuration read_configuration(const Value& document);

}  // namespace gapscope::internal::config
