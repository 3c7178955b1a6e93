#include "gapscope/base/remark.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <ostream>
#include <utility>

#include "gapscope/base/units.h"

namespace gapscope {
namespace {

/// The format with its units those of the axis. Brackets around a number are no unit's.
std::string with_units(const std::string& words, bool rotation) {
  std::string out;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = words.find('[', at), close = words.find(']', open);
    if (close == words.npos) return out + words.substr(at);
    const std::string unit = words.substr(open + 1, close - open - 1);
    const bool is_unit = unit.find('{') == unit.npos;
    out += words.substr(at, open - at) + (is_unit ? axis_unit(unit, rotation) : "[" + unit + "]");
    at = close + 1;
  }
  return out;
}

}  // namespace

Remark::Remark(std::string code, std::string words, std::vector<Value> values)
    : parts_{{std::move(code), std::move(words), std::move(values), false}} {}

Remark Remark::said(std::string text) {
  Remark remark;
  if (!text.empty()) remark.parts_.push_back({"", std::move(text), {}, true});
  return remark;
}

std::string Remark::code() const { return parts_.empty() ? "" : parts_.front().code; }

std::vector<Remark::Value> Remark::values() const {
  std::vector<Value> all;
  for (const Part& part : parts_) all.insert(all.end(), part.values.begin(), part.values.end());
  return all;
}

std::string Remark::text(bool rotation) const {
  std::string text;
  for (const Part& part : parts_) {
    if (part.said) {
      text += part.words;
      continue;
    }
    fmt::dynamic_format_arg_store<fmt::format_context> values;
    for (const Value& value : part.values)
      if (const auto* unit = std::get_if<RemarkUnit>(&value))
        values.push_back(axis_unit(unit->rotational, rotation));
      else if (const auto* number = std::get_if<double>(&value))
        values.push_back(*number);
      else if (const auto* count = std::get_if<long>(&value))
        values.push_back(*count);
      else
        values.push_back(std::get<std::string>(value));
    text += fmt::vformat(with_units(part.words, rotation), values);
  }
  return text;
}

void Remark::put_into_words(bool rotation) {
  if (parts_.empty()) return;
  std::string words = text(rotation), first = code();
  std::vector<Value> numbers = values();
  parts_ = {{std::move(first), std::move(words), std::move(numbers), true}};
}

Remark& Remark::operator+=(const Remark& more) {
  parts_.insert(parts_.end(), more.parts_.begin(), more.parts_.end());
  return *this;
}

std::ostream& operator<<(std::ostream& out, const Remark& remark) { return out << remark.text(); }

std::vector<std::string> texts_of(const std::vector<Remark>& remarks, bool rotation) {
  std::vector<std::string> texts;
  for (const Remark& remark : remarks) texts.push_back(remark.text(rotation));
  return texts;
}

}  // namespace gapscope
