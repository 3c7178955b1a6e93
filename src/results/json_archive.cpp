#include "results/json_archive.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "gapscope/base/errors.h"

namespace gapscope::internal {

Json to_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void save_json(const std::string& path, const Json& json) {
  std::ofstream out(path, std::ios::binary);
  out << json.dump(1) << '\n';
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

Json load_json(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path, "there is no such file, expected a stored result");
  try {
    return Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw ConfigError(path, std::string("is damaged: ") + error.what());
  }
}

void JsonWriter::operator()(const char* key, std::optional<bool>& value) {
  json[key] = value ? Json(*value) : Json(nullptr);
}

void JsonWriter::operator()(const char* key, Interval& value) {
  const bool known = std::isfinite(value.low) && std::isfinite(value.high);
  json[key] = known ? Json::array({value.low, value.high}) : Json(nullptr);
}

void JsonWriter::operator()(const char* key, std::vector<double>& values) {
  json[key] = Json::array();
  for (const double value : values) json[key].push_back(to_json(value));
}

void JsonWriter::bound(const char* key, double& value) {
  json[key] = std::isinf(value) ? Json(value > 0.0 ? "inf" : "-inf") : to_json(value);
}

JsonReader::JsonReader(const Json& json, std::string file, std::string place)
    : json_(json), file_(std::move(file)), place_(std::move(place)) {
  if (!json_.is_object())
    throw ConfigError(file_, (place_.empty() ? "the document" : place_) + " is not an object");
}

const Json& JsonReader::at(const char* key) const {
  const auto item = json_.find(key);
  if (item == json_.end()) fail(key, "is missing");
  return *item;
}

void JsonReader::fail(const char* key, const std::string& what) const {
  throw ConfigError(file_, place_of(key) + " " + what);
}

double JsonReader::number(const Json& json, const char* key) const {
  if (json.is_null()) return kNaN;
  if (!json.is_number()) fail(key, "is " + json.dump() + ", expected a number or null");
  return json.get<double>();
}

void JsonReader::operator()(const char* key, double& value) { value = number(at(key), key); }

void JsonReader::operator()(const char* key, int& value) {
  if (!at(key).is_number_integer()) fail(key, "is " + at(key).dump() + ", expected a whole number");
  value = at(key).get<int>();
}

void JsonReader::operator()(const char* key, bool& value) {
  if (!at(key).is_boolean()) fail(key, "is " + at(key).dump() + ", expected true or false");
  value = at(key).get<bool>();
}

void JsonReader::operator()(const char* key, std::string& value) {
  if (!at(key).is_string()) fail(key, "is " + at(key).dump() + ", expected text");
  value = at(key).get<std::string>();
}

void JsonReader::operator()(const char* key, std::optional<bool>& value) {
  value.reset();
  if (!at(key).is_null()) (*this)(key, value.emplace());
}

void JsonReader::operator()(const char* key, Interval& value) {
  value = {};
  const Json& pair = at(key);
  if (pair.is_null()) return;
  if (!pair.is_array() || pair.size() != 2) fail(key, "is " + pair.dump() + ", expected [low, high] or null");
  value = {number(pair[0], key), number(pair[1], key)};
}

void JsonReader::operator()(const char* key, std::vector<std::string>& values) {
  const Json& array = at(key);
  if (!array.is_array()) fail(key, "is not a list");
  values.clear();
  for (const Json& item : array) {
    if (!item.is_string()) fail(key, "holds " + item.dump() + ", expected text");
    values.push_back(item.get<std::string>());
  }
}

void JsonReader::operator()(const char* key, std::vector<double>& values) {
  const Json& array = at(key);
  if (!array.is_array()) fail(key, "is not a list");
  values.clear();
  for (const Json& item : array) values.push_back(number(item, key));
}

void JsonReader::bound(const char* key, double& value) {
  const Json& json = at(key);
  value = json == "inf" ? kInfinity : json == "-inf" ? -kInfinity : number(json, key);
}

}  // namespace gapscope::internal
