#include "config/configuration_schema.h"

#include <array>
#include <cmath>

#include "config/anchor_reader.h"
#include "config/configuration.h"
#include "config/controller_reader.h"
#include "config/data_reader.h"
#include "config/file_facts.h"
#include "config/model_reader.h"
#include "config/parameter_setting.h"
#include "config/schema_parts.h"
#include "config/schema_rules.h"
#include "config/schema_units.h"
#include "config/units_reader.h"
#include "gapscope/plant/effect.h"

namespace gapscope {
namespace internal::config {
namespace {

/// One of both ways to write a period; none is one turn of what it turns with.
Json period_rule(const EffectEntry& entry) {
  const Json periods = having(entry.parameters[entry.period_at()].key);
  const Json length = having(kPeriodKey);
  if (entry.turns_with == Shaft::kNone) return {{"oneOf", {periods, length}}};
  return none_of({{{"allOf", {periods, length}}}});
}

Json effect_schema(const EffectEntry& entry) {
  MapSchema parameters;
  for (const EffectParameterSpec& spec : entry.parameters) {
    parameters.add(spec.key, setting_schema(possible(spec), ""));
    const bool period = entry.period_at() >= 0 && &spec == &entry.parameters[entry.period_at()];
    const auto place = static_cast<std::size_t>(&spec - entry.parameters.data());
    if (period)
      parameters.add(kPeriodKey, setting_schema(kPossiblePeriod, "in place of periods_per_turn"));
    else if (std::isnan(neutral_value(entry, place, {})))
      parameters.required.emplace_back(spec.key);
  }
  Json effect = parameters.schema(entry.law);
  if (entry.period_at() >= 0) add_rule(period_rule(entry), effect);
  return effect;
}

Json effects_schema() {
  MapSchema one;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* entry : table) one.add(entry->name, effect_schema(*entry));
  Json item = one.schema("");
  item["minProperties"] = 1, item["maxProperties"] = 1;
  return list_schema(item, "known effects, each {name: {key: number}}; gapscope effects --laws lists them");
}

Json effect_names_schema(const std::string& doc) {
  std::vector<std::string> names;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* entry : table) names.emplace_back(entry->name);
  return list_schema(words_schema(names, ""), doc);
}

/// 0 is a drive without a load, and what is as good as 0 is none; what is fitted stays away from it.
Json mass_ratio_schema() {
  const int i = place::kMassRatio;
  const Json nearly_none = {{"exclusiveMinimum", 0}, {"exclusiveMaximum", kSmallestRatio}};
  Json ratio = drive_parameter_schema(possible_parameter(i), kDriveParameters[i].doc);
  Json &fixed = ratio["anyOf"][0], &written = ratio["anyOf"][1];
  for (Json* number : {&fixed, &written["properties"]["value"]}) (*number)["not"] = nearly_none;
  written["properties"]["given_at"] = {{"not", Json::object()}, {"description", "of a ratio: nowhere"}};
  const Json fitted = any_of({having("estimate", being(true)), lacking("value")});
  const Json above = {{"prefixItems", {Json::object(), {{"exclusiveMinimum", kSmallestRatio}}}}};
  add_rule(where(fitted, none_of({having("value", being(0))})), written);
  add_rule(where(fitted, {{"properties", {{"bounds", above}}}}), written);
  return ratio;
}

Json model_schema() {
  MapSchema rigid, contact, parameters, model;
  rigid.add("restitution", number_schema({0.0, 1.0, "-"}, "1: no energy is lost"));
  rigid.required = {"restitution"};
  contact.add("rigid", rigid.schema("impacts without duration, eq. (3)"));
  contact.required = {"rigid"};
  for (int i = 0; i < kDriveParameterCount; ++i)
    parameters.add(kDriveParameters[i].key,
                   i == place::kMassRatio
                       ? mass_ratio_schema()
                       : drive_parameter_schema(possible_parameter(i), kDriveParameters[i].doc));
  model.add("contact",
            one_of({words_schema({"compliant"}, ""), contact.schema("")}, "law of the closed contact"));
  model.add("load", words_schema({"free", "locked"}, "locked: the output does not move"));
  model.add("parameters",
            parameters.schema("a bare number is fixed; gap, motor_damping and mass_ratio are estimated "
                              "where their key is absent"));
  model.add("effects", effects_schema());
  return model.schema("the drive that is fitted, and that a simulation starts from");
}

constexpr const char* kTemperature =
    "°[CF]|℃|℉|deg[CF]($|[^A-Za-z])|"
    "(^|[^A-Za-z])([Tt]emps?|TEMPS?|[Tt]emperatur[a-z]*|[Cc]elsius|[Ff]ahrenheit|[Kk]elvin)($|[^a-z])";

/// Turns to either side, but not none.
Json gear_schema() {
  MapSchema gear = fields_schema(GearRatios{});
  for (auto& [key, ratio] : gear.properties.items())
    ratio["not"] = {{"exclusiveMinimum", -1.0 / kLargestGear}, {"exclusiveMaximum", 1.0 / kLargestGear}};
  return gear.schema("turns of the recorded axis per turn of the model's");
}

Json recording_schema() {
  MapSchema columns, resample, recording;
  const auto column = [&](const char* key, const char* doc) { columns.add(key, text_schema(doc)); };
  column("time", "default: t");
  column("input", "default: u; no temperature");
  columns.properties["input"]["not"] = {{"type", "string"}, {"pattern", kTemperature}};
  column("position", "of the motor's side; default: x1. Named alone with encoder: side: load: of the load");
  column("load_position", "default: x2, where there is one; what encoder: side: load reads");
  column("voltage", "of the supply: u is the input, a duty, times it");
  column("target", "commanded position, in the unit of the position; controller: makes the input of it");
  column("speed", "in place of position: x1 is its integral");
  column("mass", "on the arm, one number for the whole file [kg]");
  column("arm", "of that mass [m]");
  column("gain", "of the controller then, times the gain of controller:");
  resample.add("rate", number_schema({1e-3, 1e7, "Hz"}, "that the recording is brought to"));
  resample.add("for",
               words_schema({"all", "detector"}, "detector: fit and diagnose read the rows as they are"));
  resample.required = {"rate"};
  recording.add("file",
                recorded_files_schema("CSV, .mat, .npz, HDF5, MCAP, .db3 or JSON, relative to this file; "
                                      "several are never concatenated and share no rows"));
  recording.add("held_out", recorded_files_schema("only diagnose reads it; other files than file"));
  recording.add(
      "simulated",
      recorded_files_schema("what a simulator of yours answers to the same input: one for each file, or for "
                            "each file and each held_out; only diagnose reads it"));
  recording.add(
      "columns",
      columns.schema("names of the columns (of another file than a CSV: its arrays), or their places from 1 "
                     "on, each another one"));
  recording.add("rate", number_schema(kRowRates, "of the rows, where the file has no time"));
  recording.add("unwrap",
                described({{"enum", {"auto", true, false}}},
                          "a position that starts again after each turn is counted on; auto: where it stays "
                          "within a turn and steps by nearly a whole one"));
  recording.add("input_rows",
                described({{"type", "integer"}, {"minimum", -kMostInputRows}, {"maximum", kMostInputRows}},
                          "by which u is moved: -1 where a row has what acted before it"));
  recording.add("units", units_schema());
  recording.add("registers", registers_schema());
  recording.add("gear_ratio", gear_schema());
  recording.add("window",
                rising_pair_schema({-kInfinity, kInfinity, "s"},
                                   "part of each file that is used, of held_out and simulated as well"));
  recording.add("lost_rows", words_schema({"held", "bridged"},
                                          "u over rows that are missing: that of the row before, or, where "
                                          "the drive got new ones meanwhile, a line to the next row"));
  recording.add("resample", resample.schema("makes any sampling uniform"));
  recording.required = {"file"};
  return recording.schema("data from files");
}

Json simulation_schema() {
  MapSchema excitation, simulation;
  for (const ExcitationKindSpec& spec : excitation_kinds()) {
    Excitation e;
    e.kind = spec.kind;
    MapSchema fields = fields_schema(e);
    if (spec.kind == ExcitationKind::kRecorded) fields.required = {"file"};
    excitation.add(spec.name, fields.schema(spec.doc));
  }
  Json one = excitation.schema(
      "the input u(t), one of these; its frequencies are below half the rate, low <= high and "
      "has room for the lines, dwell + 4 rise <= 1");
  one["minProperties"] = 1, one["maxProperties"] = 1;
  simulation.add("rate", number_schema({1e-3, 1e7, "Hz"}, "sampling rate"));
  simulation.add("duration", number_schema({1e-6, 1e8, "s"}, "rate x duration: 50 to 2e7 samples"));
  simulation.add("seed", described({{"type", "integer"}, {"minimum", 0}}, "the only source of randomness"));
  simulation.add("excitation", one);
  simulation.add(
      "initial",
      fields_schema(InitialState{})
          .schema("state at the first sample; with a rigid contact x1 and x2 at most half the gap apart"));
  simulation.add("noise", number_schema({0.0, 1e3, "rad"}, "rms, before quantisation"));
  simulation.add("plant",
                 words_schema({"simulator", "independent"}, "independent: code that no estimator shares"));
  simulation.add("model",
                 {{"$ref", "#/properties/model"}, {"description", "the true plant, where it differs"}});
  simulation.required = {"rate", "duration", "excitation"};
  return simulation.schema("data of its own making");
}

Json encoder_schema() {
  MapSchema encoder;
  encoder.add("bits",
              described({{"type", "integer"}, {"minimum", 1}, {"maximum", 40}}, "counts per turn = 2^bits"));
  encoder.add("quantum", number_schema({1e-15, 10.0, "rad; m of a slide"}, "size of one count"));
  encoder.add("counts", number_schema({1.0, 1e12, "per turn"}, "counts per turn, in place of bits"));
  encoder.add("side", words_schema({"motor", "load", "both"},
                                   "whose position is estimated from; both: the load's validates"));
  Json one =
      encoder.schema("what its sheet says, one of bits, quantum and counts, and the body that it is on");
  one["minProperties"] = 1;
  Json pairs = Json::array();
  for (const auto& pair : {std::array{"bits", "quantum"}, {"bits", "counts"}, {"quantum", "counts"}})
    pairs.push_back({{"required", pair}});
  one["not"] = {{"anyOf", pairs}};
  return one;
}

/// Cases of each kind that are 0, all of them; what is not written is not.
Json no_implant() {
  const ImplantConfig unless_given;
  Json none = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  for (const auto& [key, cases] : {std::pair{"known", unless_given.known},
                                   {"outside", unless_given.outside},
                                   {"none", unless_given.none}}) {
    none["properties"][key] = being(0);
    if (cases > 0) none["required"].push_back(key);
  }
  return none;
}

Json detector_schema() {
  MapSchema knowledge, from, detector;
  knowledge.add("input_limit", number_schema({1e-12, 1e12, "unit of u"}, "the largest |u|"));
  knowledge.add("load_force_bound", number_schema({0.0, 1e12, "N m"}, "G, a bound of the unknown forces"));
  knowledge.required = {"input_limit", "load_force_bound"};
  from.add("from_model", knowledge.schema("eqs. (11) to (13)"));
  from.required = {"from_model"};
  detector.add("bound", one_of({words_schema({"auto"}, ""), number_schema({1e-9, 1e12, "rad/s^2"}, ""),
                                from.schema("")},
                               "L, a bound of the motor's acceleration; auto: from the data alone"));
  detector.add(
      "method",
      words_schema({"auto", "impact", "lost_motion", "paper", "literal"},
                   "auto: the loop or the impacts, whichever reads; literal: S1 to S6 as printed at a "
                   "bound; paper: the same, improved"));
  detector.add("literal",
               number_schema({1e-9, 1e12, "rad/s^2"},
                             "L of S1 to S6 as printed, read beside the rest as a third estimator"));
  Json schema = detector.schema("the model-free estimator");
  const Json bound = {{"allOf", {having("bound"), none_of({having("bound", being("auto"))})}}};
  add_rule(where(having("method", {{"enum", {"paper", "literal"}}}), bound), schema);
  add_rule(where(having("method", {{"enum", {"impact", "lost_motion"}}}), none_of({bound})), schema);
  return schema;
}

}  // namespace
}  // namespace internal::config

std::string configuration_schema() {
  using namespace internal::config;
  MapSchema root;
  root.add("name", folder_name_schema("of the report's folder; default: the name of this file"));
  root.add("recording", recording_schema());
  root.add("simulation", simulation_schema());
  root.add("encoder", encoder_schema());
  root.add("coordinates", words_schema({"rotation", "translation"}, "translation: rad and N m mean m and N"));
  root.add("model", model_schema());
  root.add("controller", controller_schema());
  root.add("anchor", anchor_schema());
  root.add("detector", detector_schema());
  root.add("fit", fields_schema(FitOptions{}).schema("how the reference is found"));
  root.add("next_experiment",
           fields_schema(ExperimentLimits{})
               .schema("what the diagnosis may propose; lowest_frequency < highest_frequency"));
  MapSchema diagnosis = fields_schema(DiagnosisKnowledge{}), implant = fields_schema(ImplantConfig{});
  diagnosis.add("exclude", effect_names_schema("effects that are no candidates"));
  implant.add("effects", effect_names_schema("that may be drawn; default: all"));
  root.add("diagnosis", diagnosis.schema("what is known before the diagnosis"));
  root.add("tolerance", fields_schema(Tolerance{}).schema("what is good enough: the card judges it"));
  implant.properties["sizes"]["minItems"] = 1;
  implant.properties["sizes"]["items"]["exclusiveMinimum"] = 0;
  Json implants = implant.schema("what gapscope blind implant puts into the recordings");
  implants["not"] = no_implant();
  root.add("implant", implants);
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}};
  schema["title"] = "Configuration of gapscope";
  schema.update(root.schema("YAML that run, detect, fit, diagnose, simulate and export read"));
  add_rules_between_blocks(schema);
  schema["oneOf"] = Json::array({{{"required", {"recording"}}}, {{"required", {"simulation"}}}});
  return schema.dump(1) + "\n";
}

}  // namespace gapscope
