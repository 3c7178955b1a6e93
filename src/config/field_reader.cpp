#include "config/field_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal {
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

}  // namespace

void FieldReader::field(const FieldSpec& s, bool& value) {
  if (const auto given = section_.find(s.key)) value = given->truth();
}

void FieldReader::field(const FieldSpec& s, int& value) {
  if (const auto given = section_.find(s.key))
    value = static_cast<int>(given->integer(clamped<int>(s.low), clamped<int>(s.high)));
}

void FieldReader::field(const FieldSpec& s, std::uint64_t& value) {
  if (const auto given = section_.find(s.key)) value = given->natural(clamped<std::uint64_t>(s.high));
}

void FieldReader::field(const FieldSpec& s, double& value) {
  if (const auto given = section_.find(s.key)) {
    value = given->number(range_of(s));
  } else if (std::isnan(value)) {
    section_.require(s.key, fmt::format("{}, {}", s.doc, to_string(range_of(s))));
  }
}

void FieldReader::field(const FieldSpec& s, std::optional<double>& value) {
  if (const auto given = section_.find(s.key)) value = given->number(range_of(s));
}

void FieldReader::field(const FieldSpec& s, std::string& value) {
  if (const auto given = section_.find(s.key)) value = given->text();
}

void FieldReader::field(const FieldSpec& s, std::vector<double>& value) {
  if (const auto given = section_.find(s.key)) value = given->numbers(range_of(s));
}

}  // namespace gapscope::internal
