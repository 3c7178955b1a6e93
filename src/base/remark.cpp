#include "gapscope/base/remark.h"

#include <fmt/args.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>
#include <utility>

#include "gapscope/base/text.h"

namespace gapscope {

std::string Remark::Part::text(Coordinates coordinates) const {
  if (said) return words;
  fmt::dynamic_format_arg_store<fmt::format_context> all;
  for (const Value& value : values)
    if (const auto* unit = std::get_if<RemarkUnit>(&value))
      all.push_back(coordinates.unit(unit->rotational));
    else if (const auto* number = std::get_if<double>(&value))
      all.push_back(*number);
    else if (const auto* count = std::get_if<long>(&value))
      all.push_back(*count);
    else
      all.push_back(std::get<std::string>(value));
  return fmt::vformat(coordinates.with_units(words), all);
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
