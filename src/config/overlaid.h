#pragma once

#include <span>

#include "config/setting.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// The document with the settings laid over it, in their order. What is on the way to a key and not there is
/// made; an item of a list is named by its place or, where it is a map of one key (an effect), by that key.
/// @throws ConfigError where the way leads through what holds no keys
Value overlaid(const Value& document, std::span<const Setting> settings);

}  // namespace gapscope::internal::config
