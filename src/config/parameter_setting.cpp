#include "config/parameter_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "config/schema_rules.h"
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

namespace {

/// What is written in place of a number.
MapSchema setting_keys(const Range& range) {
  MapSchema written;
  written.add("value", number_schema(range, "where the fit begins, within the bounds"));
  written.add("estimate", truth_schema("whether it is fitted"));
  written.add("bounds", rising_pair_schema(range, "that the fit stays within"));
  return written;
}

Json number_or(const Json& written, const Range& range, const std::string& doc) {
  return described({{"anyOf", {number_schema(range, "fixed at this value"), written}}}, doc, range.unit);
}

const char* const kFixedOrNot = "estimated, or fixed";

Json prior_schema(const Range& range) {
  MapSchema known;
  known.add("value", number_schema(range, "default: where the fit begins"));
  known.add("std", above_zero_schema(range.unit, "standard deviation"));
  known.required = {"std"};
  return known.schema("what is known beforehand");
}

/// Without a value it is fitted unless it says that it is not; what has a prior is fitted; a guess is not.
void add_rules_of_parameter(Json& written) {
  const Json fitted = having("estimate", being(true)), held = having("estimate", being(false));
  add_rule(where(lacking("value"), none_of({held})), written);
  add_rule(where({{"allOf", {having("prior"), having("value")}}}, fitted), written);
  add_rule(where(having("prior"), any_of({having("value"), having("prior.value")})), written);
  add_rule(where(having("guess", being(true)), {{"allOf", {having("value"), none_of({fitted})}}}), written);
}

}  // namespace

Json setting_schema(const Range& range, const std::string& doc) {
  Json written = setting_keys(range).schema(kFixedOrNot);
  add_rule(where(lacking("value"), having("estimate", being(true))), written);
  return number_or(written, range, doc);
}

Json begun_setting_schema(const Range& range, const std::string& doc) {
  MapSchema written = setting_keys(range);
  written.required = {"value"};
  return number_or(written.schema(kFixedOrNot), range, doc);
}

Json drive_parameter_schema(const Range& range, const std::string& doc) {
  MapSchema written = setting_keys(range);
  written.add("prior", prior_schema(range));
  written.add("given_at", words_schema({"motor", "load"},
                                       "side of the gear of recording: gear_ratio that the "
                                       "numbers hold at; default: load, the axis of x1"));
  written.add("guess", truth_schema("the value is one: what rests on it is marked"));
  Json schema = written.schema(kFixedOrNot);
  add_rules_of_parameter(schema);
  return number_or(schema, range, doc);
}

}  // namespace gapscope::internal::config
