#include "config/parameter_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "config/yaml_writer.h"

namespace gapscope::internal::config {

ParameterSetting read_setting(const Value& value, const Range& range) {
  ParameterSetting p;
  if (!value.is_map()) {
    p.value = value.number(range);
    return p;
  }
  const Section section(value, {"value", "estimate", "bounds"});
  if (const auto given = section.find("estimate")) p.estimate = given->truth();
  if (const auto given = section.find("bounds")) std::tie(p.low, p.high) = given->rising_pair(range);
  if (const auto given = section.find("value"))
    p.value = given->number(std::isnan(p.low) ? range : Range{p.low, p.high, range.unit});
  if (std::isnan(p.value) && !p.estimate)
    value.fail("has no value and is not estimated, expected a value or estimate: true");
  return p;
}

std::string setting_text(const ParameterSetting& p) {
  if (!p.estimate) return yaml_number(p.value);
  std::vector<std::string> parts;
  if (!std::isnan(p.value)) parts.push_back(fmt::format("value: {}", p.value));
  parts.emplace_back("estimate: true");
  if (!std::isnan(p.low) && !std::isnan(p.high))
    parts.push_back(fmt::format("bounds: [{}, {}]", p.low, p.high));
  if (p.prior) parts.push_back(fmt::format("prior: {{value: {}, std: {}}}", p.prior->value, p.prior->std));
  return "{" + fmt::format("{}", fmt::join(parts, ", ")) + "}";
}

Json setting_schema(const Range& range, const std::string& doc, bool prior) {
  MapSchema written;
  written.add("value", number_schema(range, "where the fit begins"));
  written.add("estimate", truth_schema("whether it is fitted"));
  written.add("bounds", rising_pair_schema(range, "that the fit stays within"));
  if (prior) {
    MapSchema known;
    known.add("value", number_schema(range, "default: where the fit begins"));
    known.add("std", number_schema({0.0, kInfinity, range.unit}, "standard deviation"));
    known.required = {"std"};
    written.add("prior", known.schema("what is known beforehand"));
    written.add("given_at", words_schema({"motor", "load"},
                                         "side of the gear of recording: gear_ratio that the "
                                         "numbers hold at; default: load, the axis of x1"));
    written.add("guess", truth_schema("the value is one: what rests on it is told so"));
  }
  return described(
      {{"anyOf", {number_schema(range, "fixed at this value"), written.schema("estimated, or fixed")}}}, doc,
      range.unit);
}

}  // namespace gapscope::internal::config
