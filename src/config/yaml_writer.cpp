#include "config/yaml_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal {

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

void YamlWriter::comment(const std::string& text) {
  text_ += std::string(2 * depth_, ' ') + "# " + text + "\n";
}

void FieldWriter::field(const FieldSpec& s, bool& value) {
  out_.entry(s.key, value ? "true" : "false", s.unit);
}
void FieldWriter::field(const FieldSpec& s, int& value) {
  out_.entry(s.key, fmt::format("{}", value), s.unit);
}
void FieldWriter::field(const FieldSpec& s, std::uint64_t& value) {
  out_.entry(s.key, fmt::format("{}", value), s.unit);
}
void FieldWriter::field(const FieldSpec& s, double& value) {
  if (!std::isnan(value)) out_.entry(s.key, yaml_number(value), s.unit);
}
void FieldWriter::field(const FieldSpec& s, std::optional<double>& value) {
  if (value) out_.entry(s.key, yaml_number(*value), s.unit);
}
void FieldWriter::field(const FieldSpec& s, std::string& value) {
  out_.entry(s.key, yaml_text(value), s.unit);
}
void FieldWriter::field(const FieldSpec& s, std::vector<double>& value) {
  out_.entry(s.key, fmt::format("[{}]", fmt::join(value, ", ")), s.unit);
}

}  // namespace gapscope::internal
