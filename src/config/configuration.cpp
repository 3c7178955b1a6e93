#include "config/configuration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "base/plain_name.h"
#include "base/require.h"
#include "config/anchor_reader.h"
#include "config/configuration_reader.h"
#include "config/controller_reader.h"
#include "config/data_reader.h"
#include "config/detector_reader.h"
#include "config/field_reader.h"
#include "config/file_facts.h"
#include "config/independent_effects.h"
#include "config/model_reader.h"
#include "config/overlaid.h"
#include "config/yaml_document.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace internal::config {
namespace {

/// The own setting at the value that was found; of what the own model does not estimate the number as it is.
void go_on(ParameterSetting own, ParameterSetting& taken) {
  if (!own.estimate || taken.estimate || std::isnan(taken.value)) return;
  own.value = std::clamp(taken.value, std::isnan(own.low) ? -kInfinity : own.low,
                         std::isnan(own.high) ? kInfinity : own.high);
  own.begun = true;
  taken = own;
}

/// The k-th effect of an entry; nullptr: there are fewer.
const ModelEffect* effect_of(const ReferenceModel& model, const EffectEntry* entry, std::size_t k) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == entry && k-- == 0) return &e;
  return nullptr;
}

/// As a search leaves alone what nothing else is known of.
void go_on_as_added(const ShaftTurns& turns, ModelEffect& effect) {
  for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i) {
    const double value = effect.parameters[i].value;
    const bool left_alone =
        effect.entry->parameters[i].held && !(std::abs(value - neutral_value(*effect.entry, i, turns)) > 0.0);
    if (!left_alone) go_on(ParameterSetting::sought(), effect.parameters[i]);
  }
}

/// Estimates the numbers of a model that stands in place of a configuration's own where that one estimates
/// them, within its bounds, from the values that they have; and those of effects that it does not have, as a
/// search would that has added them.
/// @param keep_effects  as they are: some were set
void estimate_as(const Configuration& own, bool keep_effects, ModelConfig& taken) {
  if (!own.model.given) return;
  const ReferenceModel model = own.reference_model();
  for (std::size_t i = 0; i < taken.parameters.size(); ++i) go_on(model.parameters[i], taken.parameters[i]);
  for (std::size_t e = 0; e < taken.effects.size() && !keep_effects; ++e) {
    ModelEffect& effect = taken.effects[e].effect;
    const auto before =
        std::count_if(taken.effects.begin(), taken.effects.begin() + static_cast<std::ptrdiff_t>(e),
                      [&](const EffectConfig& c) { return c.effect.entry == effect.entry; });
    if (const ModelEffect* mine = effect_of(model, effect.entry, static_cast<std::size_t>(before)))
      for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
        go_on(mine->parameters[i], effect.parameters[i]);
    else
      go_on_as_added(own.turns(), effect);
  }
}

constexpr const char* kNameForm =
    "a plain folder name of letters, digits, '_', '-' and '.', not beginning with '.' or '-'";

/// Eq. (13) needs three numbers of the model.
void require_bound_from_model(const Configuration& c) {
  if (!c.detector.from_model) return;
  for (const char* key : {"motor_inertia", "torque_constant", "mass_ratio"})
    if (std::isnan(c.model.parameters[drive_parameter_index(key)].value))
      throw ConfigError(c.file, c.detector.line,
                        fmt::format("detector.bound is from_model but {0} is not known, expected a number in "
                                    "model.parameters.{0}",
                                    key));
}

void require_possible_start(const Configuration& c) {
  const SimulationConfig& s = *c.simulation;
  const bool rigid = s.plant.structure.contact == ContactLaw::kRigid && s.plant.structure.has_load;
  const double apart = std::abs(s.initial.x1 - s.initial.x2), half = s.plant.drive.gap / 2.0;
  if (rigid && apart > half)
    throw ConfigError(
        c.file, s.line,
        fmt::format("simulation.initial has x1 and x2 {} rad apart, expected at most half the gap, {} "
                    "rad, with a rigid contact",
                    apart, half));
}

void read_diagnosis(const Value& value, Configuration& c) {
  FieldKeys known;
  c.diagnosis.fields(known);
  known.keys.emplace_back("exclude");
  const Section section(value, known.keys);
  FieldReader reader(section);
  c.diagnosis.fields(reader);
  if (const auto excluded = section.find("exclude"))
    for (const Value& effect : excluded->items())
      c.excluded.emplace_back(effect_named(effect.text(), effect).name);
}

ImplantConfig read_implant(const Value& value) {
  ImplantConfig implant;
  FieldKeys known;
  implant.fields(known);
  known.keys.emplace_back("effects");
  const Section section(value, known.keys);
  FieldReader reader(section);
  implant.fields(reader);
  implant.line = value.line();
  if (implant.cases() == 0) value.fail("asks for no case, expected known, outside or none above 0");
  for (const double size : implant.sizes)
    if (!(size > 0.0)) section.find("sizes")->fail_expecting("shares of the input's rms above 0");
  if (implant.sizes.empty()) section.find("sizes")->fail_expecting("at least one share of the input's rms");
  if (const auto effects = section.find("effects"))
    for (const Value& effect : effects->items())
      implant.effects.emplace_back(effect_named(effect.text(), effect).name);
  return implant;
}

/// Which body is read is a property of the model.
void place_encoder(Configuration& c) {
  if (c.encoder.sides == EncoderSides::kMotor) return;
  const bool locked = c.model.structure.has_load && c.model.structure.load == LoadKind::kLocked;
  const bool plant_locked = c.simulation && c.simulation->plant.structure.has_load &&
                            c.simulation->plant.structure.load == LoadKind::kLocked;
  if (locked || plant_locked)
    throw ConfigError(c.file, c.encoder.line,
                      fmt::format("encoder.side is {} and model.load locked, expected side: motor: what does "
                                  "not move shows its encoder nothing",
                                  to_string(c.encoder.sides)));
  c.model.structure.encoder = c.encoder.side();
  if (c.simulation) c.simulation->plant.structure.encoder = c.encoder.side();
}

void read_data(const Section& root, const WrittenModel& model, Configuration& c) {
  const auto recording = root.find("recording"), simulation = root.find("simulation");
  if (recording && simulation)
    simulation->fail(
        fmt::format("stands beside recording ({}), expected only one of both", recording->place()));
  if (!recording && !simulation) root.require("recording", "either recording or simulation");
  if (recording) {
    c.recording = read_recording_block(*recording, std::filesystem::path(c.file).parent_path().string(),
                                       c.encoder, c.coordinates);
    return;
  }
  c.simulation = read_simulation(*simulation, std::filesystem::path(c.file).parent_path().string());
  WrittenModel changes;
  if (const auto given = simulated_model(*simulation)) changes = read_model(*given);
  put_behind_gear(changes, {}, c.coordinates);
  c.simulation->plant = simulated_plant(overlaid(model, changes), *simulation);
  require_possible_start(c);
  if (c.simulation->independent)
    for (const EffectConfig& e : c.simulation->plant.effects)
      if (std::find(std::begin(kIndependentEffects), std::end(kIndependentEffects),
                    std::string_view(e.effect.entry->name)) == std::end(kIndependentEffects))
        throw ConfigError(
            c.file, e.line,
            fmt::format("simulation.plant is independent, which has no {}, expected {} or plant: simulator",
                        e.effect.entry->name, fmt::join(kIndependentEffects, ", ")));
}

}  // namespace

std::string read_name(const Section& root, const std::string& file) {
  if (const auto given = root.find("name")) {
    const std::string name = given->text();
    if (!is_plain_name(name)) given->fail_expecting(kNameForm);
    return name;
  }
  const std::string stem = std::filesystem::path(file).stem().string();
  if (!is_plain_name(stem)) root.require("name", kNameForm);
  return stem;
}

Configuration read_configuration(const Value& document) {
  const Section root(
      document, {"name", "recording", "simulation", "encoder", "coordinates", "model", "controller", "anchor",
                 "detector", "fit", "next_experiment", "diagnosis", "tolerance", "implant"});
  Configuration c;
  c.file = document.file();
  c.name = read_name(root, c.file);
  if (const auto coordinates = root.find("coordinates"))
    c.coordinates = coordinates->word({"rotation", "translation"}) == 0 ? Coordinates::kRotation
                                                                        : Coordinates::kTranslation;
  if (const auto encoder = root.find("encoder")) c.encoder = read_encoder(*encoder, c.coordinates);
  if (const auto detector = root.find("detector")) c.detector = read_detector(*detector);
  WrittenModel model;
  if (const auto given = root.find("model")) model = read_model(*given);
  put_behind_gear(model, root.find("recording"), c.coordinates);
  c.model = resolved_model(model);
  require_bound_from_model(c);
  read_data(root, model, c);
  read_controller(root, c);
  read_anchor(root, c);
  settle_loads(c);
  settle_periods(c.model.effects, c.turns(), c.file);
  if (c.simulation) settle_periods(c.simulation->plant.effects, c.turns(), c.file);
  place_encoder(c);
  if (c.simulation) c.fit.seed = c.simulation->seed;
  if (const auto fit = root.find("fit")) read_fields(*fit, c.fit);
  if (const auto diagnosis = root.find("diagnosis")) read_diagnosis(*diagnosis, c);
  if (const auto tolerance = root.find("tolerance")) read_fields(*tolerance, c.tolerance);
  if (const auto implant = root.find("implant")) c.implant = read_implant(*implant);
  if (const auto next = root.find("next_experiment")) {
    read_fields(*next, c.next_experiment);
    c.next_experiment_line = next->line();
    if (!(c.next_experiment.lowest_frequency < c.next_experiment.highest_frequency))
      next->fail_expecting("lowest_frequency below highest_frequency");
  }
  return c;
}

}  // namespace internal::config

ReferenceModel Configuration::reference_model() const {
  ReferenceModel fitted = model.reference_model();
  if (anchor) anchor->fix(fitted);
  if (controller && controller->estimates()) fitted.controller = controller;
  return fitted;
}

double Configuration::position_quantum() const {
  return recording ? internal::config::position_quantum(encoder, *recording) : encoder.quantum;
}

const char* to_string(EncoderSides sides) {
  return sides == EncoderSides::kLoad ? "load" : sides == EncoderSides::kBoth ? "both" : "motor";
}

InputFacts Configuration::input_facts() const {
  InputFacts input;
  input.constant_guessed = model.given && model.guessed[drive_parameter_index("torque_constant")];
  if (!recording) return input;
  const Quantity torque = coordinates.rotational() ? Quantity::kTorque : Quantity::kForce;
  const bool of_a_supply = recording->is_supplied();  // a duty times its volts
  const bool of_a_gain = !recording->reading.columns.reads_input() && internal::config::gain_is_torque(*this);
  input.unit = of_a_gain     ? coordinates.torque_unit()
               : of_a_supply ? "V"
                             : si_unit(torque, recording->units.input);
  return input;
}

ShaftTurns Configuration::turns() const {
  if (!coordinates.rotational()) return ShaftTurns::of_a_slide();
  if (!recording) return {};
  return {std::abs(recording->gear.position), std::abs(recording->gear.load_position)};
}

Configuration parse_configuration(const std::string& text, const std::string& file,
                                  std::span<const Setting> settings) {
  Configuration c;
  telling_settings(settings, [&] {
    const auto read = [&](std::span<const Setting> over) {
      return internal::config::read_configuration(
          internal::config::overlaid(internal::config::parse_document(text, file), over));
    };
    c = read(settings);
    std::vector<Setting> own;
    bool sets_effects = false;  // which the own model may not have
    for (const Setting& s : settings) {
      const bool of_effects = !s.taken && s.key.starts_with("model.effects");
      sets_effects = sets_effects || of_effects;
      if (!s.taken && !of_effects) own.push_back(s);
    }
    if (std::any_of(settings.begin(), settings.end(), [](const Setting& s) { return s.taken; }))
      internal::config::estimate_as(read(own), sets_effects, c.model);
  });
  return c;
}

Configuration load_configuration(const std::string& path, std::span<const Setting> settings) {
  return parse_configuration(internal::config::read_text(path), path, settings);
}

void require_reference_model(const Configuration& c) {
  if (!c.model.given)
    throw ConfigError(c.file, "there is no model, expected model: with parameters for the reference");
  const ReferenceModel fitted = c.reference_model();
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const ParameterSetting& p = fitted.parameters[i];
    if (!has_parameter(c.model.structure, i) || p.estimate || !std::isnan(p.value)) continue;
    throw ConfigError(
        c.file, c.model.line,
        fmt::format("model.parameters has no {0}, expected a number [{1}] or {0}: {{estimate: true}}",
                    kDriveParameters[i].key, kDriveParameters[i].unit));
  }
}

DiagnosisOptions diagnosis_options(const Configuration& c) {
  DiagnosisOptions options;
  options.fit = c.fit;
  options.known = c.diagnosis;
  options.excluded = c.excluded;
  options.coordinates = c.coordinates;
  options.turns = c.turns();
  return options;
}

void require_possible_experiment(const Configuration& c, double dt) {
  const double samples = c.next_experiment.duration / dt;
  if (samples > kMostSimulatedSamples)
    throw ConfigError(c.file, c.next_experiment_line == 0 ? 1 : c.next_experiment_line,
                      fmt::format("next_experiment.duration is {} s, {:.3g} samples at the {:.5g} Hz of the "
                                  "recording, expected at most {:.3g}",
                                  c.next_experiment.duration, samples, 1.0 / dt, kMostSimulatedSamples));
}

Interval bound_from_model(const Configuration& c) {
  GAPSCOPE_REQUIRE(c.detector.from_model.has_value());
  DriveParameters<double> drive;
  for (int i = 0; i < kDriveParameterCount; ++i) drive_parameter(drive, i) = c.model.parameters[i].value;
  return acceleration_bound(drive, *c.detector.from_model);
}

}  // namespace gapscope
