#pragma once

#include <string>

#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// The text of a file of at most 1 MiB.  @throws ConfigError
std::string read_text(const std::string& path);

/// The one document in the text as a tree: syntax checked, neither too deep nor too large; null where it is
/// empty.  @throws ConfigError
YAML::Node parse_tree(const std::string& text, const std::string& file);

/// The one document in the text: syntax checked, neither too deep nor too large.  @throws ConfigError
Value parse_document(const std::string& text, const std::string& file);

}  // namespace gapscope::internal::config
