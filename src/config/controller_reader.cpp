#include "config/controller_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "config/parameter_setting.h"
#include "config/schema_rules.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

namespace at = controller_place;

constexpr int kFixed = -1;  ///< a key whose number is always given

/// One key of a law: of a number that can be estimated, or of one that cannot.
struct LawKey {
  const char* key;
  Range range;
  const char* doc;
  int number = kFixed;  ///< place in kControllerNumbers
  double DriveController::*fixed = nullptr;
};
using LawKeys = std::vector<LawKey>;

constexpr double kGainMost = 1e12;
const LawKey kRate = {
    "rate", {0.0, 1e5, "Hz"}, "of its updates; 0: one at each row", kFixed, &DriveController::rate};
const LawKey kDelay = {
    "delay", {0.0, 1.0, "s"}, "from the reading of the position to the change of the input", at::kDelay};
const LawKey kSaturation = {"saturation",
                            {1e-12, kInfinity, "unit of u"},
                            "limit of its output, either way",
                            kFixed,
                            &DriveController::saturation};
const LawKey kDeadBand = {"dead_band",
                          {0.0, 1e6, "rad"},
                          "error up to which it takes no action",
                          kFixed,
                          &DriveController::dead_band};

const LawKey kFallsAt = {"falls_at",
                         {1e-9, 1e6, "rad"},
                         "error beyond which the gain falls: e/(1 + |e/falls_at|^n)^(1/n) stands for e",
                         kFixed,
                         &DriveController::falls_at};
const LawKey kFallsSharpness = {
    "falls_sharpness",
    {0.1, 100.0, ""},
    "the n of falls_at: 1 falls from the smallest errors on, a large one limits the error",
    kFixed,
    &DriveController::falls_sharpness};

const LawKeys kPositionAlone = {
    {"gain", {-kGainMost, kGainMost, "unit of u per rad"}, "of the position error", at::kGain},
    {"derivative",
     {-kGainMost, kGainMost, "unit of u s/rad"},
     "of its slope from update to update",
     at::kDerivative},
    {"integral",
     {-kGainMost, kGainMost, "unit of u per rad s"},
     "of its integral, which rests at saturation",
     at::kIntegral},
    kRate,
    kDelay,
    kSaturation,
    kDeadBand,
    kFallsAt,
    kFallsSharpness};
const LawKeys kPositionOfCascade = {
    {"gain", {-kGainMost, kGainMost, "1/s"}, "the speed that an error of position asks for", at::kGain},
    kDeadBand,
    kFallsAt,
    kFallsSharpness};
const LawKeys kVelocity = {
    {"gain", {-kGainMost, kGainMost, "unit of u s/rad"}, "of the error of the speed", at::kSpeedGain},
    {"integral",
     {-kGainMost, kGainMost, "unit of u per rad"},
     "of its integral, which rests at saturation",
     at::kSpeedIntegral},
    kRate,
    kDelay,
    kSaturation};

/// What the firmware makes of the goal, and the drive while it is switched off.
const LawKeys kProfile = {
    {"speed", {1e-9, 1e9, "rad/s"}, "of the goal at most", kFixed, &DriveController::profile_speed},
    {"acceleration",
     {1e-9, 1e12, "rad/s^2"},
     "of the goal at most",
     kFixed,
     &DriveController::profile_acceleration}};
const LawKeys kBesideLaws = {{"goal_filter_s",
                              {0.0, 1e3, "s"},
                              "time constant of a filter of the goal",
                              kFixed,
                              &DriveController::goal_filter},
                             {"off_damping",
                              {0.0, 1e9, "N m s/rad"},
                              "of the motor's side while it is switched off; default: motor_damping",
                              kFixed,
                              &DriveController::off_damping}};
constexpr const char *kAuto = "auto", *kGoalDelayKey = "goal_delay_s";
constexpr Range kGoalDelay = {0.0, 10.0, "s"};

std::vector<std::string> names_of(const LawKeys& keys) {
  std::vector<std::string> names;
  for (const LawKey& key : keys) names.emplace_back(key.key);
  return names;
}

bool is_gain(const LawKey& key) { return key.number == at::kGain || key.number == at::kSpeedGain; }

bool leads(const LawKey& key, ControllerKind kind) { return key.number == leading_number(kind); }

/// `gain: estimate` says what `gain: {estimate: true}` says. All but the leading number need a value to begin
/// with.
ParameterSetting read_number(const Value& value, const LawKey& key, ControllerKind kind) {
  ParameterSetting setting = value.is_text() && value.node().Scalar() == "estimate"
                                 ? ParameterSetting::sought()
                                 : read_setting(value, key.range);
  if (std::isnan(setting.value) && !leads(key, kind))
    value.fail("is to be estimated and has no value, expected {value: ..., estimate: true}");
  return setting;
}

void read_law(const Value& value, const LawKeys& keys, ControllerModel& model) {
  const Section section(value, names_of(keys));
  for (const LawKey& key : keys) {
    const auto given = section.find(key.key);
    if (!given && is_gain(key))
      section.require(key.key, fmt::format("{} [{}], or estimate", key.doc, key.range.unit));
    if (!given) continue;
    if (key.fixed != nullptr)
      model.fixed.*key.fixed = given->number(key.range);
    else
      model.numbers[key.number] = read_number(*given, key, model.fixed.kind);
  }
}

void read_fixed(const Section& section, const LawKeys& keys, DriveController& controller) {
  for (const LawKey& key : keys)
    if (const auto given = section.find(key.key)) controller.*key.fixed = given->number(key.range);
}

/// `rate: auto`, or in Hz; without the key and one of a law it is sought where a target was recorded.
void read_rate(const Section& section, bool of_law, ControllerModel& model) {
  const auto rate = section.find("rate");
  model.rate_sought = !rate && !of_law;
  if (!rate) return;
  if (of_law) rate->fail("stands beside the rate of a law, expected it once");
  model.rate_sought = rate->is_text() && rate->node().Scalar() == kAuto;
  if (!model.rate_sought) model.fixed.rate = rate->number(kRate.range);
}

bool has_rate(const std::optional<Value>& law) {
  return law && law->is_map() && law->node()["rate"].IsDefined();
}

ControllerModel read_laws(const Value& controller) {
  const Section section(
      controller, {"position", "velocity", "profile", "rate", "goal_filter_s", kGoalDelayKey, "off_damping"});
  ControllerModel model;
  if (const auto profile = section.find("profile"))
    read_fixed(Section(*profile, names_of(kProfile)), kProfile, model.fixed);
  read_fixed(section, kBesideLaws, model.fixed);
  if (const auto delay = section.find(kGoalDelayKey)) model.fixed.goal_delay = delay->number(kGoalDelay);
  const auto position = section.find("position"), velocity = section.find("velocity");
  if (!position && !velocity)
    section.require("position", "position: {gain: ...}, velocity: {gain: ...} or both, a cascade");
  model.fixed.kind = !velocity  ? ControllerKind::kPosition
                     : position ? ControllerKind::kCascade
                                : ControllerKind::kVelocity;
  for (ParameterSetting& number : model.numbers) number.value = 0.0;
  if (position) read_law(*position, velocity ? kPositionOfCascade : kPositionAlone, model);
  if (velocity) read_law(*velocity, kVelocity, model);
  read_rate(section, has_rate(position) || has_rate(velocity), model);
  return model;
}

/// What is estimated needs an input that is made of the target, row by row.
void require_estimable(const Value& controller, const RecordingConfig& recording) {
  if (recording.reading.columns.reads_input())
    controller.fail(
        "has a number to be estimated beside a recorded input, expected numbers: a note of fit then says how "
        "much of the input they leave, and at which scale");
  if (recording.reading.resample_rate && !recording.resample_for_detector)
    controller.fail(
        "has a number to be estimated and the recording is resampled, expected resample: {for: detector} or none");
}

void write_fixed(YamlWriter& out, const LawKeys& keys, const DriveController& controller) {
  for (const LawKey& key : keys)
    if (const double value = controller.*key.fixed; std::isfinite(value))
      out.quantity(key.key, yaml_number(value), key.range.unit);
}

void write_law(YamlWriter& out, const char* name, const LawKeys& keys, const ControllerModel& model,
               const std::string& unit_of_output) {
  out.open(name);
  for (const LawKey& key : keys) {
    if (model.rate_sought && key.fixed == &DriveController::rate) continue;
    if (key.fixed == &DriveController::falls_sharpness && !(model.fixed.falls_at < kInfinity)) continue;
    const std::string unit = replaced(key.range.unit, "unit of u", unit_of_output);
    if (key.fixed == nullptr) {
      const ParameterSetting& setting = model.numbers[key.number];
      out.quantity(key.key, setting_text(setting), unit);
    } else if (const double value = model.fixed.*key.fixed; std::isfinite(value)) {
      out.quantity(key.key, yaml_number(value), unit);
    }
  }
  out.close();
}

/// The leading number may be without a value, where it is known which one leads.
Json number_schema_of(const LawKey& key) {
  if (key.fixed != nullptr) return number_schema(key.range, key.doc);
  if (!is_gain(key)) return begun_setting_schema(key.range, key.doc);
  return one_of({setting_schema(key.range, ""), words_schema({"estimate"}, "by the fit")}, key.doc);
}

Json law_schema(const LawKeys& keys, const std::string& doc) {
  MapSchema law;
  for (const LawKey& key : keys) {
    law.add(key.key, number_schema_of(key));
    if (is_gain(key)) law.required.emplace_back(key.key);
  }
  return law.schema(doc);
}

/// Of the law of the position in a cascade.
Json inner_law() {
  const LawKey& gain = kPositionOfCascade.front();
  Json law = {{"propertyNames", {{"enum", names_of(kPositionOfCascade)}}}};
  law["properties"] = {{gain.key, begun_setting_schema(gain.range, "")}};
  return {{"properties", {{"position", law}}}};
}

/// A gain of its own has a recording only under a controller.
void require_controlled(const Configuration& c, bool controlled) {
  for (const auto* files : {&c.recording->files, &c.recording->held_out})
    for (const RecordedFile& file : *files)
      if (file.gain_times != 1.0 && !controlled)
        throw ConfigError(c.file, file.line,
                          "a gain stands beside " + file.given +
                              ", expected it beside a recording under a controller: that is given");
}

/// Beside a simulation the excitation is its target.
void read_simulated(const Value& controller, const ControllerModel& model, Configuration& c) {
  if (model.estimates())
    controller.fail("has a number to be estimated beside a simulation, expected numbers");
  if (c.simulation->independent)
    controller.fail("stands beside plant: independent, expected plant: simulator");
  c.controller = model;
  c.controller->rate_sought = false;
}

}  // namespace

void read_controller(const Section& root, Configuration& c) {
  const auto controller = root.find("controller");
  const bool target = c.recording && !c.recording->reading.columns.target.empty();
  if (c.recording) require_controlled(c, controller.has_value());
  if (!controller && !target) return;
  if (!controller)
    throw ConfigError(
        c.file, c.recording->files.front().line,
        "recording.columns has a target, expected controller: {position: {gain: ...}} beside it, "
        "which makes the input of it");
  const ControllerModel model = read_laws(*controller);
  if (c.simulation) return read_simulated(*controller, model, c);
  if (!target) controller->fail("is given without the target, expected recording: columns: {target: ...}");
  if (model.estimates()) require_estimable(*controller, *c.recording);
  c.controller = model;
  c.recording->reading.controller = model.at_start();
}

bool gain_is_torque(const Configuration& c) {
  const auto at = static_cast<std::size_t>(place::kTorqueConstant);
  const ParameterSetting& constant = c.model.parameters[at];
  return c.model.given && c.controller && !constant.estimate && constant.value == 1.0 && !c.model.guessed[at];
}

std::string controller_output_unit(bool supplied, bool is_torque, const DeclaredUnits& units,
                                   Coordinates coordinates) {
  if (supplied) return is_torque ? coordinates.torque_unit() + std::string("/V") : "duty";
  const Quantity torque = coordinates.rotational() ? Quantity::kTorque : Quantity::kForce;
  const std::string unit = si_unit(torque, units.input);
  return unit.empty() ? "unit of u" : unit;
}

void write_controller(YamlWriter& out, const ControllerModel& model, const std::string& unit_of_output) {
  const ControllerKind kind = model.fixed.kind;
  const DriveController& fixed = model.fixed;
  out.open("controller");
  if (std::isfinite(fixed.profile_speed) || std::isfinite(fixed.profile_acceleration)) {
    out.open("profile");
    write_fixed(out, kProfile, fixed);
    out.close();
  }
  write_fixed(out, kBesideLaws, fixed);
  if (fixed.goal_delay > 0.0)
    out.quantity(kGoalDelayKey, yaml_number(std::stod(fmt::format("{}", fixed.goal_delay))), kGoalDelay.unit);
  if (model.rate_sought) out.entry("rate", kAuto);
  if (kind != ControllerKind::kVelocity)
    write_law(out, "position", kind == ControllerKind::kCascade ? kPositionOfCascade : kPositionAlone, model,
              unit_of_output);
  if (kind != ControllerKind::kPosition) write_law(out, "velocity", kVelocity, model, unit_of_output);
  out.close();
}

Json controller_schema() {
  MapSchema controller;
  controller.add("position",
                 law_schema(kPositionAlone,
                            "of the position that is recorded; beside velocity its gain [1/s] asks "
                            "for a speed, and it has gain and dead_band alone"));
  controller.add("velocity", law_schema(kVelocity, "of the speed, of which alone the target is one"));
  MapSchema profile;
  for (const LawKey& key : kProfile) profile.add(key.key, number_schema(key.range, key.doc));
  controller.add("profile", profile.schema("of the goal, as the firmware follows it"));
  controller.add("rate", one_of({number_schema(kRate.range, ""), words_schema({kAuto}, "")},
                                "of its updates; auto, the default: at the rows or between them, as the "
                                "recordings prefer; 0: one at each row"));
  controller.add(kGoalDelayKey, number_schema(kGoalDelay, "from the host's goal to the controller"));
  for (const LawKey& key : kBesideLaws) controller.add(key.key, number_schema(key.range, key.doc));
  Json schema = controller.schema(
      "of the drive's firmware: makes the input of recording: columns: target, or of the excitation "
      "[rad] of a simulation");
  schema["anyOf"] = Json::array({{{"required", {"position"}}}, {{"required", {"velocity"}}}});
  add_rule(where(having("velocity"), inner_law()), schema);
  add_rule(where(having("rate"), none_of({having("position.rate"), having("velocity.rate")})), schema);
  return schema;
}

Json sought_by_fit() {
  const Json sought = any_of({being("estimate"), having("estimate", being(true))});
  std::vector<Json> numbers;
  for (const auto& [law, keys] :
       {std::pair{"controller.position.", kPositionAlone}, {"controller.velocity.", kVelocity}})
    for (const LawKey& key : keys)
      if (key.fixed == nullptr) numbers.push_back(having(std::string(law) + key.key, sought));
  return any_of(numbers);
}

}  // namespace gapscope::internal::config
