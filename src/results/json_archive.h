#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"
#include "gapscope/base/whole_file.h"

/// Two archives that meet the same list of fields: one writes it as JSON, the other reads it back. A struct
/// names its fields once, in `template <class Archive> void fields(Archive&, Struct&)`, so what is written is
/// what is read.
namespace gapscope::internal::results {

using Json = nlohmann::ordered_json;

/// The words of an enum in the file.
template <class Enum>
using Words = std::initializer_list<std::pair<Enum, const char*>>;

/// How every document says along what its drive moves.
template <class Archive>
void coordinates_field(Archive& archive, Coordinates& coordinates) {
  archive.choice(
      "coordinates", coordinates,
      Words<Coordinates>{{Coordinates::kRotation, "rotation"}, {Coordinates::kTranslation, "translation"}});
}

inline constexpr const char* kConfiguration = "configuration";  ///< the key of every result

/// NaN and infinities become null: a number that could not be had.
Json to_json(double value);
Json to_json(const Interval& value);
inline Json to_json(const std::string& text) { return text; }

/// What a message shows of a value: its first characters.
std::string shown_json(const Json& json);

/// The document as text: indented, or on one line (-1). What is no UTF-8, as a file may be named, is
/// replaced.
std::string text_of(const Json& json, int indent);

/// Text of a JSON document with a final newline; doubles come out shortest and read back the same.
std::string file_text(const Json& json);
void save_json(const std::string& path, const Json& json, const Replaceable& found = {});
/// @throws ConfigError where the file is missing or too large for a stored result
std::string text_of_file(const std::string& path);
/// @throws ConfigError where the file is missing or no JSON.
Json load_json(const std::string& path);
/// @param file for messages  @throws ConfigError where the text is no JSON
Json parsed_json(const std::string& text, const std::string& file);

class JsonWriter {
 public:
  Json json = Json::object();

  void operator()(const char* key, double& value) { json[key] = to_json(value); }
  void operator()(const char* key, int& value) { json[key] = value; }
  void operator()(const char* key, bool& value) { json[key] = value; }
  void operator()(const char* key, std::string& value) { json[key] = value; }
  void operator()(const char* key, Remark& value) { json[key] = value.text(); }
  void operator()(const char* key, std::optional<bool>& value);
  void operator()(const char* key, Interval& value) { json[key] = to_json(value); }
  void operator()(const char* key, std::vector<std::string>& values) { json[key] = values; }
  void operator()(const char* key, std::vector<Remark>& values) { json[key] = texts_of(values); }
  void operator()(const char* key, std::vector<double>& values);

  /// A bound may be infinite, which is no missing number: "inf" or "-inf".
  void bound(const char* key, double& value);

  /// What files of earlier versions do not have.
  void addition(const char* key, std::string& value) { (*this)(key, value); }
  void addition(const char* key, double& value) { (*this)(key, value); }
  void addition(const char* key, Remark& value) { (*this)(key, value); }
  void addition(const char* key, Interval& value) { (*this)(key, value); }

  template <class Struct>
  void added_list(const char* key, std::vector<Struct>& values) {
    list(key, values);
  }
  template <class Enum>
  void added_choice(const char* key, Enum& value, Words<Enum> words, Enum) {
    choice(key, value, words);
  }

  // What only some documents have: nothing is written where it is not there, and what was sealed without it
  // keeps its hash.
  void seldom(const char* key, std::vector<std::string>& values) {
    if (!values.empty()) (*this)(key, values);
  }
  template <class Struct>
  void seldom(const char* key, std::optional<Struct>& value) {
    if (value) single(key, *value);
  }

  template <class Enum>
  void seldom_choice(const char* key, Enum& value, Words<Enum> words, Enum without) {
    if (value != without) choice(key, value, words);
  }

  /// The configuration that a result was made from, as resolved text with its SHA-256; null where there is
  /// none.
  void configuration(std::string& resolved);

  template <class Enum>
  void choice(const char* key, Enum& value, Words<Enum> words) {
    for (const auto& [meaning, word] : words)
      if (meaning == value) json[key] = word;
  }
  template <class Struct>
  void list(const char* key, std::vector<Struct>& values) {
    json[key] = Json::array();
    for (Struct& value : values) json[key].push_back(written(value));
  }
  /// A list whose items have a name of their own, as an object.
  template <class Struct>
  void named(const char* key, std::vector<Struct>& values, std::string Struct::*name) {
    json[key] = Json::object();
    for (Struct& value : values) json[key][value.*name] = written(value);
  }
  /// One member of each item by the item's name, as an object.
  template <class Struct, class Member>
  void named_members(const char* key, std::vector<Struct>& values, std::string Struct::*name,
                     Member Struct::*member) {
    json[key] = Json::object();
    for (Struct& value : values) json[key][value.*name] = to_json(value.*member);
  }
  template <class Struct, class Member>
  void added_members(const char* key, std::vector<Struct>& values, std::string Struct::*name,
                     Member Struct::*member) {
    named_members(key, values, name, member);
  }
  template <class Struct>
  void single(const char* key, Struct& value) {
    json[key] = written(value);
  }
  template <class Struct>
  void part(const char* key, std::optional<Struct>& value) {
    json[key] = value ? written(*value) : Json(nullptr);
  }
  /// What files of earlier versions do not have, of any kind.
  template <class Value>
  void added(const char* key, Value& value) {
    if constexpr (requires { (*this)(key, value); })
      (*this)(key, value);
    else
      single(key, value);
  }

 private:
  template <class Struct>
  static Json written(Struct& value) {
    JsonWriter inner;
    fields(inner, value);
    return std::move(inner.json);
  }
};

/// Refuses what is missing or of another type with a ConfigError that names the place.
class JsonReader {
 public:
  /// @param file for messages   @param place where `json` stands in it, e.g. "model_free"
  JsonReader(const Json& json, std::string file, std::string place);

  void operator()(const char* key, double& value);
  void operator()(const char* key, int& value);
  void operator()(const char* key, bool& value);
  void operator()(const char* key, std::string& value);
  void operator()(const char* key, Remark& value);
  void operator()(const char* key, std::optional<bool>& value);
  void operator()(const char* key, Interval& value);
  void operator()(const char* key, std::vector<std::string>& values);
  void operator()(const char* key, std::vector<Remark>& values);
  void operator()(const char* key, std::vector<double>& values);
  void bound(const char* key, double& value);
  /// Empty in files that were written before it was stored.
  void addition(const char* key, std::string& value);
  void addition(const char* key, double& value);    ///< NaN there
  void addition(const char* key, Remark& value);    ///< empty there
  void addition(const char* key, Interval& value);  ///< NaN there
  void configuration(std::string& resolved);        ///< empty in files that were written before it was stored
  void seldom(const char* key, std::vector<std::string>& values) {
    values.clear();
    if (json_.contains(key)) (*this)(key, values);
  }
  template <class Struct>
  void seldom(const char* key, std::optional<Struct>& value) {
    value.reset();
    if (json_.contains(key)) single(key, value.emplace());
  }

  /// Refuses the document of another schema.
  void schema(const std::string& expected);

  /// Refuses the document for what stands at a place of it.
  [[noreturn]] void fail_at(const std::string& place, const std::string& what) const;

  template <class Enum>
  void choice(const char* key, Enum& value, Words<Enum> words) {
    const Json& word = at(key);
    std::string all;
    for (const auto& [meaning, text] : words) {
      if (word == text) return void(value = meaning);
      all += (all.empty() ? "" : ", ") + std::string(text);
    }
    fail(key, "is " + shown_json(word) + ", expected one of " + all);
  }
  template <class Struct>
  void list(const char* key, std::vector<Struct>& values) {
    const Json& array = at(key);
    if (!array.is_array()) fail(key, "is " + shown_json(array) + ", expected a list");
    values.clear();
    for (const Json& item : array) {
      const std::string place = place_of(key) + "[" + std::to_string(values.size()) + "]";
      read(item, place, values.emplace_back());
    }
  }
  template <class Struct>
  void added_list(const char* key, std::vector<Struct>& values) {  ///< empty in files without it
    values.clear();
    if (json_.contains(key)) list(key, values);
  }
  template <class Enum>
  void added_choice(const char* key, Enum& value, Words<Enum> words, Enum without) {  ///< in files without it
    value = without;
    if (json_.contains(key)) choice(key, value, words);
  }
  template <class Enum>
  void seldom_choice(const char* key, Enum& value, Words<Enum> words, Enum without) {
    added_choice(key, value, words, without);
  }
  template <class Struct>
  void named(const char* key, std::vector<Struct>& values, std::string Struct::*name) {
    const Json& object = at(key);
    if (!object.is_object()) fail(key, "is " + shown_json(object) + ", expected an object");
    values.clear();
    for (const auto& [item, json] : object.items()) {
      read(json, place_of(key) + "." + item, values.emplace_back());
      values.back().*name = item;
    }
  }
  /// Items that are there already keep their other members.
  template <class Struct, class Member>
  void named_members(const char* key, std::vector<Struct>& values, std::string Struct::*name,
                     Member Struct::*member) {
    const Json& object = at(key);
    if (!object.is_object()) fail(key, "is " + shown_json(object) + ", expected an object");
    values.resize(object.size());
    JsonReader inner(object, file_, place_of(key));
    std::size_t i = 0;
    for (const auto& [item, json] : object.items()) {
      values[i].*name = item;
      inner(item.c_str(), values[i++].*member);
    }
  }
  template <class Struct, class Member>
  /// As they were in files without it.
  void added_members(const char* key, std::vector<Struct>& values, std::string Struct::*name,
                     Member Struct::*member) {
    if (json_.contains(key)) named_members(key, values, name, member);
  }
  template <class Struct>
  void single(const char* key, Struct& value) {
    read(at(key), place_of(key), value);
  }
  template <class Struct>
  void part(const char* key, std::optional<Struct>& value) {
    value.reset();
    if (!at(key).is_null()) read(at(key), place_of(key), value.emplace());
  }
  template <class Value>
  void added(const char* key, Value& value) {  ///< as it was in files without it
    if (!json_.contains(key)) return;
    if constexpr (requires { (*this)(key, value); })
      (*this)(key, value);
    else
      single(key, value);
  }

 private:
  const Json& at(const char* key) const;
  std::string place_of(const char* key) const { return place_.empty() ? key : place_ + "." + key; }
  [[noreturn]] void fail(const char* key, const std::string& what) const;
  double number(const Json& json, const char* key) const;

  template <class Struct>
  void read(const Json& json, const std::string& place, Struct& value) const {
    JsonReader inner(json, file_, place);
    fields(inner, value);
  }

  const Json& json_;
  std::string file_;
  std::string place_;
};

}  // namespace gapscope::internal::results
