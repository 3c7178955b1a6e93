#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/yaml_value.h"
#include "gapscope/base/fields.h"

/// The pieces that a schema of a configuration is put together from.
namespace gapscope::internal::config {

using Json = nlohmann::ordered_json;

/// A schema with what it is for, and the unit in brackets where there is one.
Json described(Json schema, const std::string& doc, const std::string& unit = "");

Json number_schema(const Range& range, const std::string& doc);
Json above_zero_schema(const std::string& unit, const std::string& doc);
Json text_schema(const std::string& doc);
Json folder_name_schema(const std::string& doc);  ///< what is_plain_name() takes
Json truth_schema(const std::string& doc);
Json words_schema(const std::vector<std::string>& words, const std::string& doc);
Json list_schema(const Json& item, const std::string& doc);
/// [low, high], which a schema cannot compare.
Json rising_pair_schema(const Range& range, const std::string& doc);
Json one_of(std::vector<Json> schemas, const std::string& doc);

/// A map with these keys and no others.
struct MapSchema {
  Json properties = Json::object();
  std::vector<std::string> required;
  void add(const std::string& key, Json schema) { properties[key] = std::move(schema); }
  Json schema(const std::string& doc) const;
};

/// The keys of an options struct by its list of fields. A number that is NaN must be given.
class FieldSchemas : public FieldVisitor {
 public:
  explicit FieldSchemas(MapSchema& map) : map_(map) {}

 private:
  void visit(const FieldSpec& s, FieldRef field) override;
  MapSchema& map_;
};

template <class Struct>
MapSchema fields_schema(Struct object) {
  MapSchema map;
  FieldSchemas fields(map);
  object.fields(fields);
  return map;
}

}  // namespace gapscope::internal::config
