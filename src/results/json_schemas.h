#pragma once

#include <string>
#include <vector>

namespace gapscope {

struct JsonSchema {
  std::string name;  ///< "result"
  std::string text;  ///< JSON Schema, draft 2020-12
};

/// The schema of every kind of JSON document that is written, made from the lists of fields by which it is
/// written and read; by name.
std::vector<JsonSchema> json_schemas();

}  // namespace gapscope
