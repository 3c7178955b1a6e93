#include "gapscope/base/remark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "base/require.h"
#include "base/text.h"

namespace gapscope {

namespace {

constexpr char kLength = '\x01';  ///< after a field: its number is a length, told with its own prefix

/// What is written of a number: "8810" rather than "8.81e+03".
std::string without_exponent(const std::string& number, double value) {
  constexpr double kLongest = 1e6;
  return std::abs(value) < kLongest && number.find("e+") != number.npos
             ? fmt::format("{:.0f}", std::stod(number))
             : number;
}

/// "2.97 mrad", "19 mm": the prefix keeps the number from 1 to 1000.
std::string length_text(const std::string& form, double value, Coordinates coordinates) {
  static constexpr std::array kPrefixes = {"", "m", "µ", "n"};
  std::size_t thousands = 0;
  const double size = std::abs(value);
  while (size > 0.0 && thousands + 1 < kPrefixes.size() &&
         std::stod(fmt::format(fmt::runtime(form), size * std::pow(1e3, thousands))) < 1.0)
    ++thousands;
  const double shown = value * std::pow(1e3, thousands);
  return without_exponent(fmt::format(fmt::runtime(form), shown), shown) + " " + kPrefixes[thousands] +
         coordinates.position_unit();
}

std::string field_text(const std::string& form, const Remark::Value& value, bool length,
                       Coordinates coordinates) {
  if (const auto* unit = std::get_if<RemarkUnit>(&value)) return coordinates.shown_unit(unit->rotational);
  if (const auto* count = std::get_if<long>(&value)) return fmt::format(fmt::runtime(form), *count);
  if (const auto* text = std::get_if<std::string>(&value)) return fmt::format(fmt::runtime(form), *text);
  const double number = std::get<double>(value);
  return length && std::isfinite(number) ? length_text(form, number, coordinates)
                                         : without_exponent(fmt::format(fmt::runtime(form), number), number);
}

}  // namespace

std::string Remark::Part::text(Coordinates coordinates) const {
  if (said) return words;
  const std::string told = coordinates.with_units(replaced(words, "} [rad]", std::string("}") + kLength));
  std::string out;
  std::size_t next = 0;
  for (std::size_t at = 0; at < told.size();) {
    if (told[at] != '{') {
      out += told[at++];
      continue;
    }
    const std::size_t end = told.find('}', at);
    GAPSCOPE_REQUIRE(end != told.npos && next < values.size());
    const bool length = end + 1 < told.size() && told[end + 1] == kLength;
    out += field_text(told.substr(at, end + 1 - at), values[next++], length, coordinates);
    at = end + (length ? 2 : 1);
  }
  return out;
}

Remark::Remark(std::string code, std::string words, std::vector<Value> values)
    : parts_{{std::move(code), std::move(words), std::move(values), false}} {}

Remark Remark::said(std::string text) {
  Remark remark;
  if (!text.empty()) remark.parts_.push_back({"", std::move(text), {}, true});
  return remark;
}

std::string Remark::code() const { return parts_.empty() ? "" : parts_.front().code; }

std::string Remark::codes() const {
  std::vector<std::string> all;
  for (const Part& part : parts_)
    if (!part.code.empty() && !contains(all, part.code)) all.push_back(part.code);
  return fmt::format("{}", fmt::join(all, "/"));
}

bool Remark::has_code(const std::string& code) const {
  return std::ranges::find(parts_, code, &Part::code) != parts_.end();
}

Remark Remark::behind(const std::string& code) const {
  Remark rest;
  auto at = std::ranges::find(parts_, code, &Part::code);
  if (at != parts_.end()) rest.parts_.assign(std::next(at), parts_.end());
  return rest;
}

std::vector<Remark::Value> Remark::values() const {
  std::vector<Value> all;
  for (const Part& part : parts_) all.insert(all.end(), part.values.begin(), part.values.end());
  return all;
}

std::string Remark::text(Coordinates coordinates) const {
  std::string text;
  for (const Part& part : parts_) text += part.text(coordinates);
  return text;
}

void Remark::put_into_words(Coordinates coordinates) {
  for (Part& part : parts_) part.words = part.text(coordinates), part.said = true;
}

Remark& Remark::operator+=(const Remark& more) {
  parts_.insert(parts_.end(), more.parts_.begin(), more.parts_.end());
  return *this;
}

std::ostream& operator<<(std::ostream& out, const Remark& remark) { return out << remark.text(); }

std::vector<std::string> texts_of(const std::vector<Remark>& remarks, Coordinates coordinates) {
  std::vector<std::string> texts;
  for (const Remark& remark : remarks) texts.push_back(remark.text(coordinates));
  return texts;
}

}  // namespace gapscope
