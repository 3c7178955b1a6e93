#include "config/schema_parts.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace gapscope::internal::config {
namespace {

Json in_range(Json schema, double low, double high) {
  if (std::isfinite(low)) schema["minimum"] = low;
  if (std::isfinite(high)) schema["maximum"] = high;
  return schema;
}

struct TypeOfField {
  const FieldSpec& spec;
  Json operator()(const bool*) const { return {{"type", "boolean"}}; }
  Json operator()(const int*) const { return in_range({{"type", "integer"}}, spec.low, spec.high); }
  Json operator()(const std::uint64_t*) const {
    return in_range({{"type", "integer"}}, std::max(0.0, spec.low), spec.high);
  }
  Json operator()(const double*) const { return in_range({{"type", "number"}}, spec.low, spec.high); }
  Json operator()(const std::optional<double>*) const { return (*this)(static_cast<const double*>(nullptr)); }
  Json operator()(const std::string*) const { return text_schema(""); }
  Json operator()(const std::vector<double>*) const {
    return {{"type", "array"}, {"items", (*this)(static_cast<const double*>(nullptr))}};
  }
};

}  // namespace

Json described(Json schema, const std::string& doc, const std::string& unit) {
  const std::string text = unit.empty() || unit == "-" ? doc : doc + " [" + unit + "]";
  if (!text.empty()) schema["description"] = text;
  return schema;
}

Json number_schema(const Range& range, const std::string& doc) {
  return described(in_range({{"type", "number"}}, range.low, range.high), doc, range.unit);
}

Json above_zero_schema(const std::string& unit, const std::string& doc) {
  return described({{"type", "number"}, {"exclusiveMinimum", 0}}, doc, unit);
}

/// A text that looks like a number or a truth value is one for YAML.
Json text_schema(const std::string& doc) {
  Json text = {{"type", {"string", "number", "boolean"}}, {"minLength", 1}};
  text["pattern"] = "^[^\\u0000-\\u0008\\u000b\\u000c\\u000e-\\u001f\\u007f]+$";
  return described(text, doc);
}

Json folder_name_schema(const std::string& doc) {
  Json name = text_schema(doc);
  name["pattern"] = "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}$";
  name["minimum"] = 0;  // its sign cannot begin a name
  return name;
}

Json truth_schema(const std::string& doc) { return described({{"type", "boolean"}}, doc); }

Json words_schema(const std::vector<std::string>& words, const std::string& doc) {
  return described({{"enum", words}}, doc);
}

Json list_schema(const Json& item, const std::string& doc) {
  return described({{"type", "array"}, {"items", item}}, doc);
}

Json rising_pair_schema(const Range& range, const std::string& doc) {
  Json pair = list_schema(in_range({{"type", "number"}}, range.low, range.high), "");
  pair["minItems"] = 2, pair["maxItems"] = 2;
  return described(pair, doc + "; [low, high] with low < high", range.unit);
}

Json one_of(std::vector<Json> schemas, const std::string& doc) {
  return described({{"anyOf", std::move(schemas)}}, doc);
}

Json MapSchema::schema(const std::string& doc) const {
  Json map = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) map["required"] = required;
  return described(map, doc);
}

void FieldSchemas::visit(const FieldSpec& s, FieldRef field) {
  map_.add(s.key, described(std::visit(TypeOfField{s}, field), s.doc, s.unit));
  const auto number = std::get_if<double*>(&field);
  if (number && std::isnan(**number)) map_.required.emplace_back(s.key);
}

}  // namespace gapscope::internal::config
