#include "config/yaml_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal::config {
namespace {

using Written = std::optional<std::string>;  ///< nothing where a field is left out

Written written(bool value) { return value ? "true" : "false"; }
Written written(int value) { return fmt::format("{}", value); }
Written written(std::uint64_t value) { return fmt::format("{}", value); }
Written written(double value) {
  if (std::isnan(value)) return {};
  return yaml_number(value);
}
Written written(const std::optional<double>& value) {
  if (!value) return {};
  return yaml_number(*value);
}
Written written(const std::string& value) {
  if (value.empty()) return {};
  return yaml_text(value);
}
Written written(const std::vector<double>& value) { return fmt::format("[{}]", fmt::join(value, ", ")); }

}  // namespace

std::string yaml_number(double value) { return fmt::format("{}", value); }

std::string yaml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += std::string("\\") + c;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += fmt::format("\\x{:02x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

void YamlWriter::open(const std::string& key) {
  text_ += std::string(2 * depth_, ' ') + key + ":\n";
  ++depth_;
}

void YamlWriter::entry(const std::string& key, const std::string& value, const std::string& comment) {
  text_ += std::string(2 * depth_, ' ') + key + ": " + value;
  text_ += comment.empty() || comment == "-" ? "\n" : "  # " + comment + "\n";
}

void YamlWriter::quantity(const std::string& key, const std::string& value, const std::string& unit) {
  entry(key, value, coordinates_.unit(unit));
}

void YamlWriter::comment(const std::string& text) {
  text_ += std::string(2 * depth_, ' ') + "# " + text + "\n";
}

void FieldWriter::visit(const FieldSpec& s, FieldRef field) {
  const auto text = std::visit([](const auto* value) { return written(*value); }, field);
  if (text) out_.quantity(s.key, *text, s.unit);
}

}  // namespace gapscope::internal::config
