#include "config/schema_units.h"

#include <initializer_list>

#include "config/data_config.h"
#include "config/schema_rules.h"
#include "recording/unit_names.h"

namespace gapscope::internal::config {
namespace {

/// What any of these quantities is measured in: a name, or what one recorded unit is in SI.
Json unit_schema(std::initializer_list<Quantity> quantities, bool counts) {
  std::vector<std::string> names;
  bool torque = false;
  for (const Quantity q : quantities) {
    for (const std::string& name : unit_names(q)) names.push_back(name);
    torque = torque || q == Quantity::kTorque;
  }
  if (counts) names.insert(names.end(), {"counts", "inc"});
  std::vector<Json> written = {{{"enum", names}},
                               {{"type", "number"}, {"minimum", 1e-15}, {"maximum", 1e15}},
                               {{"type", "string"}, {"pattern", "^[0-9.]+([eE][-+]?[0-9]+)?$"}}};
  if (torque) written.push_back({{"type", "string"}, {"pattern", "^[mk]?N[ .*·⋅]?m$"}});
  return any_of(std::move(written));
}

Json unit_of(const char* key, std::initializer_list<Quantity> travels,
             std::initializer_list<Quantity> inputs) {
  const std::string column = key;
  if (column == "time") return unit_schema({Quantity::kTime}, false);
  if (column == "voltage") return unit_schema({Quantity::kVoltage}, false);
  if (column == "speed") return unit_schema({Quantity::kTurning, Quantity::kSliding}, false);
  return column == "input" ? unit_schema(inputs, false) : unit_schema(travels, true);
}

}  // namespace

Json units_schema() {
  MapSchema units = fields_schema(DeclaredUnits{});
  for (auto& [key, schema] : units.properties.items())
    schema = described(
        unit_of(key.c_str(), {Quantity::kAngle, Quantity::kLength}, {Quantity::kTorque, Quantity::kForce}),
        schema.value("description", ""));
  return units.schema("a name, or the size of one recorded unit in SI");
}

Json registers_schema() {
  MapSchema form, registers;
  form.add("sign_bit", described({{"type", "integer"}, {"minimum", 1}, {"maximum", 51}},
                                 "bit above the size, counted from 0"));
  form.add("offset", number_schema({-1e15, 1e15}, "the register where the number is 0"));
  Json one = form.schema("one of the two");
  one["minProperties"] = one["maxProperties"] = 1;
  for (const char* key : {"input", "position", "load_position"})
    registers.add(key, any_of({{{"type", "integer"}, {"minimum", 0}, {"maximum", 52}}, one}));
  return registers.schema(
      "how signed numbers were held that were read without their sign: bits of two's complement, a sign bit or an "
      "offset");
}

Json units_of_axis(Coordinates coordinates) {
  const bool turns = coordinates.rotational();
  const Quantity travel = turns ? Quantity::kAngle : Quantity::kLength;
  const Quantity input = turns ? Quantity::kTorque : Quantity::kForce;
  Json units = Json::object();
  for (const char* key : {"input", "position", "load_position"}) units[key] = unit_of(key, {travel}, {input});
  return {{"properties", {{"recording", {{"properties", {{"units", {{"properties", units}}}}}}}}}};
}

}  // namespace gapscope::internal::config
