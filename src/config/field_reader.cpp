#include "config/field_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal::config {
namespace {

Range range_of(const FieldSpec& s) { return {s.low, s.high, s.unit}; }

template <class Integer>
Integer clamped(double value) {
  return value <= static_cast<double>(std::numeric_limits<Integer>::min())
             ? std::numeric_limits<Integer>::min()
         : value >= static_cast<double>(std::numeric_limits<Integer>::max())
             ? std::numeric_limits<Integer>::max()
             : static_cast<Integer>(value);
}

void set(bool& value, const Value& given, const FieldSpec&) { value = given.truth(); }
void set(int& value, const Value& given, const FieldSpec& s) {
  value = static_cast<int>(given.integer(clamped<int>(s.low), clamped<int>(s.high)));
}
void set(std::uint64_t& value, const Value& given, const FieldSpec& s) {
  value = given.natural(clamped<std::uint64_t>(s.high));
}
void set(double& value, const Value& given, const FieldSpec& s) { value = given.number(range_of(s)); }
void set(std::optional<double>& value, const Value& given, const FieldSpec& s) {
  value = given.number(range_of(s));
}
void set(std::string& value, const Value& given, const FieldSpec&) { value = given.text(); }
void set(std::vector<double>& value, const Value& given, const FieldSpec& s) {
  value = given.numbers(range_of(s));
}

}  // namespace

void FieldReader::visit(const FieldSpec& s, FieldRef field) {
  if (const auto given = section_.find(s.key)) {
    std::visit([&](auto* value) { set(*value, *given, s); }, field);
  } else if (const auto number = std::get_if<double*>(&field); number && std::isnan(**number)) {
    section_.require(s.key, fmt::format("{}, {}", s.doc, to_string(range_of(s))));
  }
}

}  // namespace gapscope::internal::config
