#include "config/schema_rules.h"

#include "config/controller_reader.h"
#include "config/independent_effects.h"
#include "config/model_reader.h"
#include "config/schema_units.h"
#include "gapscope/plant/effect.h"

namespace gapscope::internal::config {
namespace {

const std::string kParameters = "model.parameters.", kSimulated = "simulation.model.";

/// A parameter with a number.
Json with_number(const std::string& place) {
  return having(place, any_of({{{"type", "number"}}, {{"required", {"value"}}, {"type", "object"}}}));
}

/// One that is fitted.
Json estimated(const std::string& place) {
  const Json asked = {
      {"type", "object"}, {"properties", {{"estimate", being(true)}}}, {"required", {"estimate"}}};
  const Json without = {{"type", "object"}, {"not", {{"required", {"value"}}}}};
  return having(place, any_of({asked, without}));
}

/// A drive without a load.
Json unloaded(const std::string& model) {
  const std::string ratio = model + "parameters.mass_ratio";
  Json fixed = {{"type", "object"}, {"properties", {{"value", being(0)}}}, {"required", {"value"}}};
  fixed["not"] = {{"properties", {{"estimate", being(true)}}}, {"required", {"estimate"}}};
  return having(ratio, any_of({being(0), fixed}));
}

Json locked(const std::string& model) { return having(model + "load", being("locked")); }
Json rigid(const std::string& model) { return having(model + "contact", {{"type", "object"}}); }

/// What a structure has no place for is not fitted.
Json fits_only(const DriveStructure& structure) {
  std::vector<Json> fitted;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (!has_parameter(structure, i) && i != place::kMassRatio)
      fitted.push_back(estimated(kParameters + kDriveParameters[i].key));
  return none_of(fitted);
}

void add_structure_rules(Json& c) {
  DriveStructure no_load, no_motion, no_contact;
  no_load.has_load = false;
  no_motion.load = LoadKind::kLocked;
  no_contact.contact = ContactLaw::kRigid;
  add_rule(where(unloaded("model."), none_of({locked("model.")})), c);
  add_rule(where(unloaded("model."), fits_only(no_load)), c);
  add_rule(where(locked("model."), fits_only(no_motion)), c);
  add_rule(where(locked("model."), none_of({estimated(kParameters + "mass_ratio")})), c);
  add_rule(where(rigid("model."), fits_only(no_contact)), c);
  const Json load_moves = none_of({locked("model."), locked(kSimulated)});
  add_rule(where(having("encoder.side", {{"enum", {"load", "both"}}}), load_moves), c);
}

/// The plant that is simulated has numbers.
void add_plant_rules(Json& c) {
  const auto given = [&](const char* key) {
    return any_of({with_number(kParameters + key), with_number(kSimulated + "parameters." + key)});
  };
  const auto either = [](Json (*is)(const std::string&)) { return any_of({is("model."), is(kSimulated)}); };
  const Json simulated = having("simulation");
  for (const char* key : {"motor_inertia", "torque_constant", "motor_damping"})
    add_rule(where(simulated, given(key)), c);
  add_rule(where(simulated, any_of({either(locked), given("mass_ratio")})), c);
  add_rule(where(simulated, any_of({either(unloaded), given("gap")})), c);
  add_rule(where(simulated, any_of({either(unloaded), either(rigid), given("contact_stiffness")})), c);
  std::vector<Json> known;
  for (const char* effect : kIndependentEffects) known.push_back(having(effect));
  const Json other = {{"contains", none_of(known)}};
  add_rule(
      where(having("simulation.plant", being("independent")),
            none_of({having("simulation.model.effects", other),
                     having("controller"),
                     {{"allOf", {having("model.effects", other), lacking("simulation.model.effects")}}}})),
      c);
}

/// Of a slide nothing turns.
void add_slide_rules(Json& c) {
  const Json slide = having("coordinates", being("translation"));
  std::vector<Json> turning = {having("encoder.bits"), having("encoder.counts"), having("anchor.mass")};
  for (int i = 0; i < kDriveParameterCount; ++i)
    turning.push_back(having(kParameters + kDriveParameters[i].key + ".given_at", being("motor")));
  for (const EffectEntry* entry : effect_table()) {
    if (entry->period_at() < 0) continue;
    const char* const periods = entry->parameters[entry->period_at()].key;
    const Json open = {{"type", "object"}, {"not", {{"anyOf", {having(periods), having(kPeriodKey)}}}}};
    turning.push_back(having("model.effects", {{"contains", having(entry->name, open)}}));
  }
  add_rule(where(slide, none_of(turning)), c);
  Json units = where(slide, units_of_axis(Coordinates::kTranslation));
  units["else"] = units_of_axis(Coordinates::kRotation);
  add_rule(units, c);
}

void add_unit_rules(Json& c) {
  const Json counted = any_of({having("encoder.bits"), having("encoder.quantum"), having("encoder.counts")});
  add_rule(where(having("recording.units.position", being("counts")), counted), c);
  add_rule(where(having("recording.units.load_position", being("counts")),
                 {{"allOf", {counted, having("encoder.side", being("load"))}}}),
           c);
  for (int i = 0; i < kDriveParameterCount; ++i)
    add_rule(where(having(kParameters + kDriveParameters[i].key + ".given_at", being("motor")),
                   having("recording.gear_ratio.position")),
             c);
}

Json files_with_gain() {
  std::vector<Json> either;
  for (const char* key : {"gain", "gain_times"}) {
    const Json one = {{"type", "object"}, {"required", {key}}, {"properties", {{key, none_of({being(1)})}}}};
    either.push_back(one), either.push_back({{"type", "array"}, {"contains", one}});
  }
  return any_of(either);
}

void add_controller_rules(Json& c) {
  const Json target = having("recording.columns.target"), controller = having("controller");
  add_rule(where(target, controller), c);
  add_rule(where({{"allOf", {controller, having("recording")}}}, target), c);
  const Json sought = {{"allOf", {controller, sought_by_fit()}}};
  add_rule(where(sought, none_of({having("simulation"),
                                  having("recording.columns.input"),
                                  {{"allOf",
                                    {having("recording.resample"),
                                     none_of({having("recording.resample.for", being("detector"))})}}}})),
           c);
  const Json facts = {{"type", "object"}, {"minProperties", 2}};
  const Json some = any_of({facts, {{"type", "array"}, {"contains", facts}}});
  add_rule(none_of({having("recording.simulated", some)}), c);
  add_rule(where(lacking("controller"), none_of({having("recording.file", files_with_gain()),
                                                 having("recording.held_out", files_with_gain())})),
           c);
}

Json having_effect(const char* name) { return having("model.effects", {{"contains", having(name)}}); }

void add_anchor_rules(Json& c) {
  add_rule(where(having("anchor.inertia"), none_of({having("model.parameters.motor_inertia")})), c);
  add_rule(where(having("anchor.friction"), none_of({having_effect("motor_coulomb_friction")})), c);
  const Json geared = none_of({{{"enum", {1, -1}}}});
  add_rule(where({{"allOf", {having("anchor.mass"), having("recording")}}},
                 none_of({having_effect("load_unbalance")})),
           c);
  add_rule(
      where(having("anchor.mass"), none_of({locked("model."), having("recording.gear_ratio.position", geared),
                                            having("recording.gear_ratio.load_position", geared)})),
      c);
}

void add_detector_rules(Json& c) {
  for (const char* key : {"motor_inertia", "torque_constant", "mass_ratio"})
    add_rule(where(having("detector.bound", {{"type", "object"}}), with_number(kParameters + key)), c);
}

}  // namespace

Json having(const std::string& place, const Json& schema) {
  const std::size_t dot = place.find('.');
  const std::string key = place.substr(0, dot);
  return {{"type", "object"},
          {"required", {key}},
          {"properties", {{key, dot == place.npos ? schema : having(place.substr(dot + 1), schema)}}}};
}

Json lacking(const std::string& place) { return none_of({having(place)}); }
Json being(const Json& value) { return {{"const", value}}; }
Json any_of(std::vector<Json> schemas) { return {{"anyOf", std::move(schemas)}}; }
Json none_of(std::vector<Json> schemas) { return {{"not", any_of(std::move(schemas))}}; }
Json where(const Json& condition, const Json& consequence) {
  return {{"if", condition}, {"then", consequence}};
}

void add_rule(const Json& rule, Json& schema) { schema["allOf"].push_back(rule); }

void add_rules_between_blocks(Json& configuration) {
  add_structure_rules(configuration);
  add_plant_rules(configuration);
  add_slide_rules(configuration);
  add_unit_rules(configuration);
  add_controller_rules(configuration);
  add_anchor_rules(configuration);
  add_detector_rules(configuration);
}

}  // namespace gapscope::internal::config
