#include "cli/field_help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace gapscope::cli {

void FieldHelp::line(const FieldSpec& s, const std::string& value) {
  const std::string unit = *s.unit == '\0' ? "" : fmt::format(" [{}]", s.unit);
  text_ += fmt::format("{}{:<26}{}; {}\n", indent_, s.key + unit, s.doc, value);
}

void FieldHelp::field(const FieldSpec& s, bool& value) { line(s, value ? "default true" : "default false"); }
void FieldHelp::field(const FieldSpec& s, int& value) { line(s, fmt::format("default {}", value)); }
void FieldHelp::field(const FieldSpec& s, std::uint64_t& value) { line(s, fmt::format("default {}", value)); }
void FieldHelp::field(const FieldSpec& s, double& value) {
  line(s, std::isnan(value) ? "required" : fmt::format("default {}", value));
}
void FieldHelp::field(const FieldSpec& s, std::optional<double>& value) {
  line(s, value ? fmt::format("default {}", *value) : "optional");
}
void FieldHelp::field(const FieldSpec& s, std::string& value) { line(s, fmt::format("default '{}'", value)); }
void FieldHelp::field(const FieldSpec& s, std::vector<double>& value) {
  line(s, fmt::format("default [{}]", fmt::join(value, ", ")));
}

}  // namespace gapscope::cli
