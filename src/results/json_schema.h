#pragma once

#include <set>

#include "results/json_archive.h"

namespace gapscope::internal::results {

/// The third archive: of a list of fields it makes the JSON schema of what JsonWriter writes. Every key but
/// the configuration and additions is required; further ones are allowed, as later versions may add some.
class SchemaWriter {
 public:
  void operator()(const char* key, double&) { add(key, type_of(0.0)); }
  void operator()(const char* key, int&) { add(key, {{"type", "integer"}}); }
  void operator()(const char* key, bool&) { add(key, {{"type", "boolean"}}); }
  void operator()(const char* key, std::string&) { add(key, type_of(std::string())); }
  void operator()(const char* key, std::optional<bool>&) { add(key, {{"type", {"boolean", "null"}}}); }
  void operator()(const char* key, Interval&);
  void operator()(const char* key, Remark&) { add(key, type_of(std::string())); }
  void operator()(const char* key, std::vector<Remark>&) { add(key, list_of(type_of(std::string()))); }
  void operator()(const char* key, std::vector<std::string>&) { add(key, list_of(type_of(std::string()))); }
  void operator()(const char* key, std::vector<double>&) { add(key, list_of(type_of(0.0))); }
  void bound(const char* key, double&);
  template <class Value>
  void addition(const char* key, Value& value) {
    (*this)(key, value);
    additions_.insert(key);
  }
  void seldom(const char* key, std::vector<std::string>& values) {
    (*this)(key, values);
    additions_.insert(key);
  }
  template <class Struct>
  void seldom(const char* key, std::optional<Struct>&) {
    Struct value{};
    add(key, schema_of(value));
    additions_.insert(key);
  }
  void configuration(std::string&);

  template <class Enum>
  void choice(const char* key, Enum&, Words<Enum> words) {
    Json all = Json::array();
    for (const auto& [meaning, word] : words) all.push_back(word);
    add(key, {{"enum", all}});
  }
  template <class Struct>
  void list(const char* key, std::vector<Struct>&) {
    Struct item{};
    add(key, list_of(schema_of(item)));
  }
  template <class Struct>
  void added_list(const char* key, std::vector<Struct>& values) {
    list(key, values);
    additions_.insert(key);
  }
  template <class Enum>
  void added_choice(const char* key, Enum& value, Words<Enum> words, Enum) {
    choice(key, value, words);
    additions_.insert(key);
  }
  template <class Enum>
  void seldom_choice(const char* key, Enum& value, Words<Enum> words, Enum without) {
    added_choice(key, value, words, without);
  }
  template <class Struct>
  void named(const char* key, std::vector<Struct>&, std::string Struct::*) {
    Struct item{};
    add(key, map_of(schema_of(item)));
  }
  template <class Struct, class Member>
  void named_members(const char* key, std::vector<Struct>&, std::string Struct::*, Member Struct::*) {
    add(key, map_of(type_of(Member{})));
  }
  template <class Struct, class Member>
  void added_members(const char* key, std::vector<Struct>& values, std::string Struct::*name,
                     Member Struct::*member) {
    named_members(key, values, name, member);
    additions_.insert(key);
  }
  template <class Struct>
  void single(const char* key, Struct& value) {
    add(key, schema_of(value));
  }
  template <class Struct>
  void part(const char* key, std::optional<Struct>&) {
    Struct value{};
    add(key, {{"anyOf", {schema_of(value), {{"type", "null"}}}}});
  }

  template <class Value>
  void added(const char* key, Value& value) {
    if constexpr (requires { (*this)(key, value); })
      (*this)(key, value);
    else
      single(key, value);
    additions_.insert(key);
  }

  void constant(const char* key, const std::string& value) { add(key, {{"const", value}}); }
  void count(const char* key) { add(key, {{"type", "integer"}, {"minimum", 0}}); }
  void erase(const char* key) { properties_.erase(key); }

  Json schema() const;

  template <class Struct>
  static Json schema_of(Struct& value) {
    SchemaWriter inner;
    fields(inner, value);
    return inner.schema();
  }

 private:
  static Json type_of(double) { return {{"type", {"number", "null"}}}; }
  static Json type_of(const Interval&);
  static Json type_of(const std::string&) { return {{"type", "string"}}; }
  static Json list_of(const Json& item) { return {{"type", "array"}, {"items", item}}; }
  static Json map_of(const Json& item) { return {{"type", "object"}, {"additionalProperties", item}}; }
  void add(const char* key, const Json& schema) { properties_[key] = schema; }

  Json properties_ = Json::object();
  std::set<std::string> additions_ = {kConfiguration};  ///< not required
};

/// The schema of a document that begins with the name of its own ("gapscope.result/1").
template <class Struct>
Json document_schema(const std::string& name, Struct&& value) {
  SchemaWriter writer;
  fields(writer, value);
  writer.constant("schema", name);
  return writer.schema();
}

// One for each kind of document, beside what writes it.
Json result_schema();
Json timing_schema();
Json diagnosis_schema();
Json export_schema();
Json check_schema();
Json compare_schema();
Json campaign_schema();
Json blind_schema();
Json blind_labels_schema();
Json blind_manifest_schema();
Json blind_answers_schema();
Json stream_schema();
Json files_schema();

}  // namespace gapscope::internal::results
