#pragma once

#include "config/schema_parts.h"

/// What a schema says of several keys at once: of a map, or of places far apart.
namespace gapscope::internal::config {

/// What has a value at that place ("model.load"), one that is as the schema says.
Json having(const std::string& place, const Json& schema = Json::object());
Json lacking(const std::string& place);  ///< what has none
Json being(const Json& value);           ///< this very value
Json none_of(std::vector<Json> schemas);
Json any_of(std::vector<Json> schemas);
Json where(const Json& condition, const Json& consequence);

/// One rule more.
void add_rule(const Json& rule, Json& schema);

/// The rules between the blocks of a configuration, those that a schema can say.
void add_rules_between_blocks(Json& configuration);

}  // namespace gapscope::internal::config
