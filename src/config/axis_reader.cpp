#include "config/axis_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "config/yaml_writer.h"
#include "gapscope/base/errors.h"

namespace gapscope {

AxisValue axis_value(const std::string& yaml) {
  AxisValue value{yaml, kNaN};
  const char* const last = yaml.data() + yaml.size();
  const auto [end, problem] = std::from_chars(yaml.data(), last, value.number);
  if (problem != std::errc() || end != last || !std::isfinite(value.number)) value.number = kNaN;
  return value;
}

namespace internal::config {
namespace {

constexpr int kDigits = 9, kLogDigits = 6;

/// A path is followed key by key, and told in full.
void require_short(const std::string& path, const Value& value) {
  constexpr std::size_t kMost = 200;
  if (path.size() > kMost)
    throw ConfigError(value.file(), value.line(),
                      fmt::format("the path {}... has {} characters, expected at most {}", path.substr(0, 40),
                                  path.size(), kMost));
}

/// Maps and lists in braces and brackets, on one line.
void in_one_line(YAML::Node node) {
  if (node.IsScalar() || node.IsNull()) return;
  node.SetStyle(YAML::EmitterStyle::Flow);
  for (auto entry : node) in_one_line(node.IsMap() ? entry.second : YAML::Node(entry));
}

AxisValue listed_value(const Value& item) {
  const YAML::Node node = item.node();
  if (node.IsScalar() && node.Tag() == "?") return axis_value(node.Scalar());
  if (node.IsScalar()) return {yaml_text(node.Scalar()), kNaN};
  YAML::Node copy = YAML::Clone(node);
  in_one_line(copy);
  return {YAML::Dump(copy), kNaN};
}

Interval read_range(const Value& value, bool logarithmic) {
  const auto [low, high] = value.rising_pair(logarithmic ? Range{1e-300, kInfinity, ""} : Range{});
  return {low, high};
}

std::uint64_t read_count(const Section& section, bool continuous) {
  const auto count = section.find("count");
  if (!count && continuous) return 0;
  const std::uint64_t n = section.require("count", "how many values, ends included").natural(kMostCounted);
  if (n < 2) count->fail(fmt::format("is {}, expected at least 2 (both ends)", n));
  return n;
}

WrittenAxis read_repeat(const Section& section, WrittenAxis a) {
  const Value count = *section.find("repeat");
  a.axis.repeat = true;
  a.count = count.natural(kMostCounted);
  if (a.count == 0) count.fail("is 0, expected at least 1");
  if (const auto seed = section.find("seed")) a.first_seed = seed->natural(std::uint64_t{1} << 62);
  return a;
}

}  // namespace

WrittenAxis read_axis(const std::string& path, const Value& value, bool continuous) {
  require_short(path, value);
  WrittenAxis a;
  a.axis.path = path;
  a.axis.line = value.line();
  if (value.is_list()) {
    for (const Value& item : value.items()) a.axis.values.push_back(listed_value(item));
    a.count = a.axis.values.size();
    if (a.count == 0) value.fail("is an empty list, expected at least one value");
    return a;
  }
  const std::string expected =
      "a list, {range: [low, high], count: n}, {log_range: [low, high], count: n} or {repeat: n, seed: first}";
  if (!value.is_map()) value.fail_expecting(expected);
  const Section section(value, {"range", "log_range", "repeat", "count", "seed"});
  const auto range = section.find("range"), log_range = section.find("log_range");
  if (range.has_value() + log_range.has_value() + section.find("repeat").has_value() != 1)
    value.fail("has not exactly one of range, log_range and repeat, expected " + expected);
  if (section.find("count") && section.find("repeat"))
    value.fail("has a count beside repeat, expected " + expected);
  if (section.find("seed") && !section.find("repeat"))
    value.fail("has a seed without repeat, expected " + expected);
  if (section.find("repeat")) return read_repeat(section, a);
  a.axis.logarithmic = log_range.has_value();
  a.axis.range = read_range(log_range ? *log_range : *range, a.axis.logarithmic);
  a.count = read_count(section, continuous);
  return a;
}

AxisValue axis_number(double value, int digits) { return axis_value(fmt::format("{:.{}g}", value, digits)); }

CampaignAxis filled(WrittenAxis written) {
  CampaignAxis& axis = written.axis;
  if (!axis.values.empty()) return axis;
  const auto last = static_cast<double>(written.count - 1);
  for (std::uint64_t i = 0; i < written.count; ++i) {
    if (axis.repeat) {
      const std::uint64_t seed = written.first_seed + i;
      axis.values.push_back({fmt::format("{}", seed), static_cast<double>(seed)});
    } else {
      const double share = static_cast<double>(i) / last;
      axis.values.push_back(
          axis.logarithmic
              ? axis_number(axis.range.low * std::pow(axis.range.high / axis.range.low, share), kLogDigits)
              : axis_number(axis.range.low + share * (axis.range.high - axis.range.low), kDigits));
    }
  }
  return axis;
}

CampaignDraw read_draw(const std::string& path, const Value& value) {
  require_short(path, value);
  const Section section(value, {"uniform", "log_uniform"});
  const auto uniform = section.find("uniform"), log_uniform = section.find("log_uniform");
  if (uniform.has_value() == log_uniform.has_value())
    value.fail_expecting("either {uniform: [low, high]} or {log_uniform: [low, high]}");
  return {path, read_range(uniform ? *uniform : *log_uniform, log_uniform.has_value()),
          log_uniform.has_value(), value.line()};
}

}  // namespace internal::config
}  // namespace gapscope
