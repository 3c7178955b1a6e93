#include "config/yaml_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "base/shown.h"
#include "base/text.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

/// The whole text as a number of type T; nothing if it is none or does not fit.
template <class T>
std::optional<T> parsed(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A whole number, also where it is written as 16.0 or 1e3.
template <class Integer>
std::optional<Integer> parsed_whole(std::string_view text) {
  constexpr double kTold = 9e18;  // within 64 bits, with and without a sign
  if (const auto value = parsed<Integer>(text)) return value;
  const auto value = parsed<double>(text);
  const bool fits = value && std::abs(*value) <= kTold && *value == std::floor(*value) &&
                    (*value >= 0.0 || std::is_signed_v<Integer>);
  return fits ? std::optional(static_cast<Integer>(*value)) : std::nullopt;
}

std::string with_unit(const std::string& text, const char* unit) {
  return *unit == '\0' || std::string_view(unit) == "-" ? text : text + " " + unit;
}

std::string unknown_key(const std::string& key, const std::string& where,
                        const std::vector<std::string>& known) {
  const std::string place = where.empty() ? "" : " in " + where;
  const std::string& near = nearest_name(key, known);
  const bool alike = edit_distance(key, near) <= std::max<std::size_t>(2, near.size() / 3);
  if (known.size() == 1) return fmt::format("unknown key {}{}, expected {}", shown(key), place, known[0]);
  if (alike)
    return fmt::format("unknown key {}{}, expected {} (or one of {})", shown(key), place, near,
                       fmt::join(known, ", "));
  return fmt::format("unknown key {}{}, expected one of {} (nearest: {})", shown(key), place,
                     fmt::join(known, ", "), near);
}

}  // namespace

std::string to_string(const Range& range) {
  if (range.low == -kInfinity && range.high == kInfinity) return "a finite number";
  if (range.high == kInfinity) return with_unit(fmt::format("{}", range.low), range.unit) + " or more";
  if (range.low == -kInfinity) return with_unit(fmt::format("{}", range.high), range.unit) + " or less";
  return with_unit(fmt::format("{} to {}", range.low, range.high), range.unit);
}

std::string Value::kind() const {
  if (node_.IsMap()) return "a map";
  if (node_.IsSequence()) return "a list";
  if (!node_.IsScalar()) return "empty";
  return node_.Tag() == "?" ? shown(node_.Scalar()) : "the text " + shown(node_.Scalar());
}

void Value::fail(const std::string& what) const {
  throw ConfigError(source_->file, line_, path_.empty() ? what : path_ + " " + what);
}

void Value::fail_expecting(const std::string& what) const {
  if (path_.empty()) throw ConfigError(source_->file, line_, "the file is " + kind() + ", expected " + what);
  fail("is " + kind() + ", expected " + what);
}

/// A scalar without quotes and tags: what can be a number or a truth value.
const std::string& Value::plain(const std::string& expected) const {
  if (!node_.IsScalar() || node_.Tag() != "?") fail_expecting(expected);
  return node_.Scalar();
}

double Value::number(const Range& range) const {
  const std::string expected = to_string(range);
  const auto value = parsed<double>(
      plain(range.low == -kInfinity && range.high == kInfinity ? "a number" : "a number, " + expected));
  if (!value) fail_expecting("a number" + (expected == "a finite number" ? "" : ", " + expected));
  if (!std::isfinite(*value) || *value < range.low || *value > range.high)
    fail(fmt::format("is {}, expected {}", with_unit(node_.Scalar(), range.unit), expected));
  return *value;
}

std::int64_t Value::integer(std::int64_t low, std::int64_t high) const {
  const std::string expected = fmt::format("a whole number from {} to {}", low, high);
  const auto value = parsed_whole<std::int64_t>(plain(expected));
  if (!value || *value < low || *value > high) fail_expecting(expected);
  return *value;
}

std::uint64_t Value::natural(std::uint64_t high) const {
  const std::string expected = fmt::format("a whole number from 0 to {}", high);
  const auto value = parsed_whole<std::uint64_t>(plain(expected));
  if (!value || *value > high) fail_expecting(expected);
  return *value;
}

bool Value::truth() const {
  const std::string& word = plain("true or false");
  const bool is_true = word == "true" || word == "True" || word == "TRUE";
  if (!is_true && word != "false" && word != "False" && word != "FALSE") fail_expecting("true or false");
  return is_true;
}

std::string Value::text() const {
  if (!node_.IsScalar() || (node_.Tag() != "?" && node_.Tag() != "!")) fail_expecting("a text");
  const std::string& text = node_.Scalar();
  if (text.empty()) fail("is an empty text, expected a text");
  if (text.find('\0') != text.npos || !gapscope::is_text(text))
    fail("is " + shown(text) + ", expected a text without control characters");
  return node_.Scalar();
}

std::string Value::place_of(int line) const {
  return line < 0 ? source_->settings[static_cast<std::size_t>(-1 - line)] : fmt::format("line {}", line);
}

/// A value within this one: of the setting that laid it over the file, else of that of this one, else of the
/// line of the mark.
Value Value::below(const YAML::Node& node, const std::string& path, const YAML::Node& marked) const {
  const auto own = source_->laid_over.find(path);
  const bool has_line = line_ >= 0 && !marked.Mark().is_null();
  const int line = own != source_->laid_over.end() ? line_of_setting(own->second)
                   : has_line                      ? marked.Mark().line + 1
                                                   : line_;
  return {node, path, source_, line};
}

std::vector<Value> Value::items() const {
  if (!is_list()) fail_expecting("a list");
  std::vector<Value> out;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const YAML::Node item = node_[i];
    out.push_back(below(item, fmt::format("{}[{}]", path_, i), item));
  }
  return out;
}

std::vector<double> Value::numbers(const Range& range) const {
  std::vector<double> out;
  for (const Value& item : items()) out.push_back(item.number(range));
  return out;
}

std::pair<double, double> Value::rising_pair(const Range& range) const {
  if (!is_list()) fail_expecting("two numbers [low, high]");
  const std::vector<double> ends = numbers(range);
  if (ends.size() != 2) fail(fmt::format("has {} numbers, expected two, [low, high]", ends.size()));
  if (ends[0] >= ends[1])
    fail(fmt::format("is [{}, {}], expected [low, high] with low < high", ends[0], ends[1]));
  return {ends[0], ends[1]};
}

std::vector<std::pair<std::string, Value>> Value::entries() const {
  if (!is_map()) fail_expecting("a map");
  std::vector<std::pair<std::string, Value>> out;
  std::map<std::string, int> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const Value value = below(entry.second, path_.empty() ? key : path_ + "." + key, entry.first);
    if (!entry.first.IsScalar())
      throw ConfigError(source_->file, value.line_, "a key is no text, expected a plain key");
    const auto [first, is_new] = seen.emplace(key, value.line_);
    if (!is_new)
      throw ConfigError(source_->file, value.line_,
                        fmt::format("the key {} is there twice, expected it once (it is also in {})",
                                    shown(key), place_of(first->second)));
    out.emplace_back(key, value);
  }
  return out;
}

std::size_t Value::word(const std::vector<std::string>& words) const {
  const std::string expected = fmt::format("{}", fmt::join(words, " or "));
  if (!is_text()) fail_expecting(expected);
  const auto found = std::find(words.begin(), words.end(), node_.Scalar());
  if (found == words.end()) fail_expecting(expected);
  return static_cast<std::size_t>(found - words.begin());
}

Section::Section(const Value& value, const std::vector<std::string>& known) : value_(value) {
  if (!value.is_map()) value.fail_expecting(fmt::format("a map with {}", fmt::join(known, ", ")));
  for (auto& [key, entry] : value.entries()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw ConfigError(value.file(), entry.line(), unknown_key(key, value.path(), known));
    values_.emplace(key, entry);
  }
}

std::optional<Value> Section::find(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

Value Section::require(const std::string& key, const std::string& expected) const {
  if (auto value = find(key)) return *value;
  if (!value_.path().empty()) value_.fail(fmt::format("has no {}, expected {}", key, expected));
  value_.fail(fmt::format("there is no {}, expected {}", key, expected));
}

}  // namespace gapscope::internal::config
