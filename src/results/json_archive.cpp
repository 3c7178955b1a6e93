#include "results/json_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/input_file.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/whole_file.h"
#include "results/sha256.h"

namespace gapscope::internal::results {

std::string shown_json(const Json& json) {
  constexpr std::size_t kMost = 40;
  const std::string text = json.dump(-1, ' ', true);
  return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

Json to_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Interval& value) {
  const bool known = std::isfinite(value.low) && std::isfinite(value.high);
  return known ? Json::array({value.low, value.high}) : Json(nullptr);
}

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string file_text(const Json& json) { return text_of(json, 1) + "\n"; }

void save_json(const std::string& path, const Json& json, const Replaceable& found) {
  write_whole_file(
      path, [&](std::ostream& out) { out << file_text(json); }, found);
}

namespace {

constexpr int kDeepestFollowed = 64;  ///< levels that are followed; no stored result has as many

/// Walks a valid JSON text until it stands before the value of one place.
class JsonWalk {
 public:
  JsonWalk(std::string_view text, const std::string& place) : text_(text), wanted_(place) {}

  /// Place of the value in the text; npos if it is not there.
  std::size_t find() {
    value("", 0);
    return found_;
  }

 private:
  bool done() const { return found_ != std::string_view::npos || at_ >= text_.size(); }
  void blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  std::string word() {  // a string, escapes as they stand
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    const std::string inside(text_.substr(begin, at_ - begin));
    ++at_;
    return inside;
  }

  void value(const std::string& place, int depth) {
    blanks();
    if (done()) return;
    if (place == wanted_ || depth > kDeepestFollowed)
      return void(found_ = place == wanted_ ? at_ : text_.size());
    if (text_[at_] == '{' || text_[at_] == '[') return members(place, depth);
    if (text_[at_] == '"') return void(word());
    at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
  }

  void members(const std::string& place, int depth) {
    const bool object = text_[at_++] == '{';
    for (int index = 0; !done(); ++index) {
      blanks();
      if (done() || text_[at_] == '}' || text_[at_] == ']') break;
      if (text_[at_] == ',') ++at_, blanks();
      std::string inner = place + "[" + std::to_string(index) + "]";
      if (object) {
        inner = (place.empty() ? "" : place + ".") + word();
        at_ = std::min(text_.find(':', at_), text_.size() - 1) + 1;
      }
      value(inner, depth + 1);
    }
    if (!done()) ++at_;
  }

  std::string_view text_;
  const std::string& wanted_;
  std::size_t at_ = 0, found_ = std::string_view::npos;
};

/// The line of a byte of a text.
int line_of_byte(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

/// The bracket or brace of a JSON text that opens the given level, the outermost being 1; npos if none does.
std::size_t byte_of_level(std::string_view text, std::size_t level) {
  std::size_t open = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if ((c == '[' || c == '{') && ++open == level) return i;
    if ((c == ']' || c == '}') && open > 0) --open;
  }
  return text.npos;
}

/// The line, from 1, on which a value stands in a valid JSON text: place is "model_free.events[3].t1_s", ""
/// for the whole. Of a place that is not there, the line of the nearest one around it that is.
int line_of_place(std::string_view text, std::string place) {
  for (;;) {
    const std::size_t at = JsonWalk(text, place).find();
    if (at != std::string_view::npos && at < text.size()) return line_of_byte(text, at);
    const std::size_t last = place.find_last_of(".[");
    if (place.empty()) return 1;
    place = last == std::string::npos ? "" : place.substr(0, last);
  }
}

constexpr std::size_t kDeepest = 32;               ///< levels; no stored result has as many
constexpr std::uintmax_t kMostBytes = 256u << 20;  ///< of a stored result; its traces are in other files

/// A key that an object has twice would be read as one by us and as the other by somebody else.
class KeysOnce {
 public:
  explicit KeysOnce(const std::string& file) : file_(file) {}
  bool operator()(int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_->emplace_back();
    if (event == Json::parse_event_t::object_end) keys_->pop_back();
    if (event == Json::parse_event_t::key && !keys_->back().insert(parsed.get<std::string>()).second)
      throw ConfigError(file_,
                        "has the key " + shown_json(parsed) + " twice in one object, expected it once");
    return true;
  }

 private:
  std::string file_;
  std::shared_ptr<std::vector<std::set<std::string>>> keys_ =  // the parser copies its callback
      std::make_shared<std::vector<std::set<std::string>>>();
};

/// The number that is too large for a double, as what() quotes it.
std::string quoted_number(const Json::out_of_range& error) {
  const std::string what = error.what();
  const std::size_t begin = what.find('\'') + 1;
  return what.substr(begin, what.rfind('\'') - begin);
}

}  // namespace

std::string text_of_file(const std::string& path) {
  std::ifstream in = open_input_file(path, "a stored result");
  if (std::filesystem::file_size(path) > kMostBytes)
    throw ConfigError(path, "is larger than 256 MiB, expected a stored result");
  return {std::istreambuf_iterator<char>(in), {}};
}

Json parsed_json(const std::string& text, const std::string& file) {
  const auto refusal = [&](std::size_t byte, const std::string& what) {
    return ConfigError(file, line_of_byte(text, byte), what + ", expected a stored result");
  };
  if (const std::size_t deep = byte_of_level(text, kDeepest + 1); deep != text.npos)
    throw refusal(deep, fmt::format("is nested in more than {} levels", kDeepest));
  try {
    return Json::parse(text, KeysOnce(file));
  } catch (const Json::parse_error& error) {
    throw refusal(error.byte > 0 ? error.byte - 1 : 0, "is no valid JSON from here on");
  } catch (const Json::out_of_range& error) {
    const std::string number = quoted_number(error);
    throw refusal(text.find(number), "has the number " + number.substr(0, 40) + ", which is too large");
  }
}

Json load_json(const std::string& path) { return parsed_json(text_of_file(path), path); }

void JsonWriter::operator()(const char* key, std::optional<bool>& value) {
  json[key] = value ? Json(*value) : Json(nullptr);
}

void JsonWriter::operator()(const char* key, std::vector<double>& values) {
  json[key] = Json::array();
  for (const double value : values) json[key].push_back(to_json(value));
}

void JsonWriter::bound(const char* key, double& value) {
  json[key] = std::isinf(value) ? Json(value > 0.0 ? "inf" : "-inf") : to_json(value);
}

void JsonWriter::configuration(std::string& resolved) {
  json[kConfiguration] =
      resolved.empty() ? Json(nullptr) : Json{{"sha256", sha256(resolved)}, {"resolved", resolved}};
}

JsonReader::JsonReader(const Json& json, std::string file, std::string place)
    : json_(json), file_(std::move(file)), place_(std::move(place)) {
  if (!json_.is_object()) fail_at(place_, "is " + shown_json(json_) + ", expected an object");
}

const Json& JsonReader::at(const char* key) const {
  const auto item = json_.find(key);
  if (item == json_.end()) fail(key, "is missing, expected all that this version stores");
  return *item;
}

void JsonReader::fail(const char* key, const std::string& what) const { fail_at(place_of(key), what); }

void JsonReader::fail_at(const std::string& place, const std::string& what) const {
  const std::string message = (place.empty() ? "the document" : place) + " " + what;
  if (!std::filesystem::is_regular_file(file_)) throw ConfigError(file_, message);
  throw ConfigError(file_, line_of_place(text_of_file(file_), place), message);
}

void JsonReader::schema(const std::string& expected) {
  std::string found;
  (*this)("schema", found);
  if (found != expected) fail("schema", "is \"" + found + "\", expected \"" + expected + "\"");
}

double JsonReader::number(const Json& json, const char* key) const {
  if (json.is_null()) return kNaN;
  if (!json.is_number()) fail(key, "is " + shown_json(json) + ", expected a number or null");
  return json.get<double>();
}

void JsonReader::operator()(const char* key, double& value) { value = number(at(key), key); }

void JsonReader::operator()(const char* key, int& value) {
  const Json& json = at(key);
  constexpr double kMost = std::numeric_limits<int>::max();
  if (!json.is_number_integer() || std::abs(json.get<double>()) > kMost)
    fail(key, "is " + shown_json(json) + ", expected a whole number");
  value = json.get<int>();
}

void JsonReader::operator()(const char* key, bool& value) {
  if (!at(key).is_boolean()) fail(key, "is " + shown_json(at(key)) + ", expected true or false");
  value = at(key).get<bool>();
}

void JsonReader::operator()(const char* key, std::string& value) {
  if (!at(key).is_string()) fail(key, "is " + shown_json(at(key)) + ", expected text");
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
  if (!pair.is_array() || pair.size() != 2)
    fail(key, "is " + shown_json(pair) + ", expected [low, high] or null");
  value = {number(pair[0], key), number(pair[1], key)};
}

void JsonReader::operator()(const char* key, Remark& value) {
  std::string text;
  (*this)(key, text);
  value = Remark::said(std::move(text));
}

void JsonReader::operator()(const char* key, std::vector<Remark>& values) {
  std::vector<std::string> texts;
  (*this)(key, texts);
  values.clear();
  for (std::string& text : texts) values.push_back(Remark::said(std::move(text)));
}

void JsonReader::operator()(const char* key, std::vector<std::string>& values) {
  const Json& array = at(key);
  if (!array.is_array()) fail(key, "is " + shown_json(array) + ", expected a list");
  values.clear();
  for (const Json& item : array) {
    if (!item.is_string()) fail(key, "holds " + shown_json(item) + ", expected text");
    values.push_back(item.get<std::string>());
  }
}

void JsonReader::operator()(const char* key, std::vector<double>& values) {
  const Json& array = at(key);
  if (!array.is_array()) fail(key, "is " + shown_json(array) + ", expected a list");
  values.clear();
  for (const Json& item : array) values.push_back(number(item, key));
}

void JsonReader::bound(const char* key, double& value) {
  const Json& json = at(key);
  value = json == "inf" ? kInfinity : json == "-inf" ? -kInfinity : number(json, key);
}

void JsonReader::addition(const char* key, std::string& value) {
  value.clear();
  if (json_.contains(key)) (*this)(key, value);
}

void JsonReader::addition(const char* key, double& value) {
  value = kNaN;
  if (json_.contains(key)) (*this)(key, value);
}

void JsonReader::addition(const char* key, Remark& value) {
  value = {};
  if (json_.contains(key)) (*this)(key, value);
}

void JsonReader::addition(const char* key, Interval& value) {
  value = {};
  if (json_.contains(key)) (*this)(key, value);
}

void JsonReader::configuration(std::string& resolved) {
  resolved.clear();
  if (const Json made = json_.value(kConfiguration, Json()); !made.is_null()) {
    JsonReader reader(made, file_, place_of(kConfiguration));
    std::string hash;
    reader("resolved", resolved);
    reader("sha256", hash);
    if (hash != sha256(resolved)) reader.fail("sha256", "is not that of `resolved`, expected it unchanged");
  }
}

}  // namespace gapscope::internal::results
