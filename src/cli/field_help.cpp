#include "cli/field_help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace gapscope::cli {

namespace {

std::string written(bool value) { return value ? "default true" : "default false"; }
std::string written(int value) { return fmt::format("default {}", value); }
std::string written(std::uint64_t value) { return fmt::format("default {}", value); }
std::string written(double value) {
  return std::isnan(value) ? "required" : fmt::format("default {}", value);
}
std::string written(const std::optional<double>& value) {
  return value ? fmt::format("default {}", *value) : "optional";
}
std::string written(const std::string& value) { return fmt::format("default '{}'", value); }
std::string written(const std::vector<double>& value) {
  return fmt::format("default [{}]", fmt::join(value, ", "));
}

}  // namespace

void FieldHelp::visit(const FieldSpec& s, FieldRef field) {
  const std::string unit = *s.unit == '\0' ? "" : fmt::format(" [{}]", s.unit);
  const std::string value = std::visit([](const auto* v) { return written(*v); }, field);
  text_ += fmt::format("{}{:<26}{}; {}\n", indent_, s.key + unit, s.doc, value);
}

}  // namespace gapscope::cli
