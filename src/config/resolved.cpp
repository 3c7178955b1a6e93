#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "config/anchor_reader.h"
#include "config/configuration.h"
#include "config/controller_reader.h"
#include "config/file_facts.h"
#include "config/parameter_setting.h"
#include "config/units_reader.h"
#include "config/yaml_writer.h"

namespace gapscope {
namespace {

using internal::config::FieldWriter;
using internal::config::setting_text;
using internal::config::yaml_number;
using internal::config::yaml_text;
using internal::config::YamlWriter;

/// "a, b, c"
std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ", "));
}

void write_recording(YamlWriter& out, const RecordingConfig& recording) {
  out.open("recording");
  for (const auto& [key, files] : {std::pair{"file", &recording.files},
                                   {"held_out", &recording.held_out},
                                   {"simulated", &recording.simulated}})
    internal::config::write_files(out, key, *files);
  out.open("columns");
  const RecordingColumns& columns = recording.reading.columns;
  if (columns.rate == 0.0) out.entry("time", yaml_text(columns.time));
  if (columns.reads_input()) out.entry("input", yaml_text(columns.input));
  if (recording.reading.encoder == EncoderSide::kLoad && !columns.position_named)
    out.comment("position: " + yaml_text(columns.position) + " of the motor, not read");
  else
    out.entry(columns.position_is_speed ? "speed" : "position", yaml_text(columns.position));
  if (columns.load_position_required) {
    out.entry("load_position", yaml_text(columns.load_position));
  } else {
    out.comment("load_position: " + yaml_text(columns.load_position) + " where there is one");
  }
  if (!columns.voltage.empty()) out.entry("voltage", yaml_text(columns.voltage));
  if (!columns.target.empty()) out.entry("target", yaml_text(columns.target));
  for (const auto& [key, name] : {std::pair{"mass", &recording.mass_column},
                                  {"arm", &recording.arm_column},
                                  {"gain", &recording.gain_column}})
    if (!name->empty()) out.entry(key, yaml_text(*name));
  out.close();
  internal::config::write_rows(out, recording.reading);
  internal::config::write_units(out, recording);
  if (const auto& window = recording.reading.window)
    out.entry("window", fmt::format("[{}, {}]", window->first, window->second), "s");
  if (recording.reading.lost_rows == LostRows::kBridged)
    out.entry("lost_rows", "bridged", "u over them is a line to the next row");
  if (const auto& rate = recording.reading.resample_rate)
    out.entry("resample",
              fmt::format("{{rate: {}{}}}", *rate, recording.resample_for_detector ? ", for: detector" : ""),
              "Hz");
  out.close();
}

void write_structure(YamlWriter& out, const DriveStructure& structure) {
  const bool rigid = structure.contact == ContactLaw::kRigid;
  out.entry("contact",
            rigid ? fmt::format("{{rigid: {{restitution: {}}}}}", structure.restitution) : "compliant");
  out.entry("load", structure.load == LoadKind::kFree ? "free" : "locked");
}

/// As many digits as come back from a period and its reciprocal.
double to_fifteen_digits(double value) { return std::stod(fmt::format("{:.15g}", value)); }

/// Along a slide a period is a length, such as the pitch of a screw.
std::string period_text(ParameterSetting p) {
  const auto length = [](double periods) { return to_fifteen_digits(2.0 * std::numbers::pi / periods); };
  p.value = length(p.value);
  std::tie(p.low, p.high) = std::pair(length(p.high), length(p.low));
  return "period_rad: " + setting_text(p);
}

void write_effects(YamlWriter& out, const std::vector<EffectConfig>& effects, Coordinates coordinates) {
  std::vector<std::string> list;
  for (const EffectConfig& effect : effects) {
    std::vector<std::string> keys;
    const EffectEntry& entry = *effect.effect.entry;
    for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
      const ParameterSetting& p = effect.effect.parameters[i];
      const bool length = !coordinates.rotational() && static_cast<int>(i) == entry.period_at();
      keys.push_back(length ? period_text(p)
                            : fmt::format("{}: {}", entry.parameters[i].key, setting_text(p)));
    }
    list.push_back(fmt::format("{{{}: {{{}}}}}", entry.name, joined(keys)));
  }
  out.entry("effects", "[" + joined(list) + "]");
}

void write_model(YamlWriter& out, const ModelConfig& model, Coordinates coordinates) {
  if (!model.given) return;
  out.open("model");
  write_structure(out, model.structure);
  out.open("parameters");
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const ParameterSetting& p = model.parameters[i];
    if (!p.estimate && std::isnan(p.value)) continue;
    const bool derived = p.estimate && (std::isnan(p.low) || std::isnan(p.value));
    out.quantity(
        kDriveParameters[i].key,
        model.guessed[i] ? fmt::format("{{value: {}, guess: true}}", p.value) : setting_text(p),
        std::string(kDriveParameters[i].unit) + (derived ? "; what is not here the fit derives" : ""));
  }
  out.close();
  write_effects(out, model.effects, coordinates);
  out.close();
}

void write_plant(YamlWriter& out, const SimulatedPlant& plant, Coordinates coordinates) {
  out.open("model");
  write_structure(out, plant.structure);
  const int ratio = drive_parameter_index("mass_ratio");
  out.open("parameters");
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (has_parameter(plant.structure, i) || (i == ratio && !plant.structure.has_load))
      out.quantity(kDriveParameters[i].key, yaml_number(drive_parameter(plant.drive, i)),
                   kDriveParameters[i].unit);
  out.close();
  write_effects(out, plant.effects, coordinates);
  out.close();
}

void write_simulation(YamlWriter& out, SimulationConfig simulation, Coordinates coordinates) {
  FieldWriter fields(out);
  out.open("simulation");
  out.entry("rate", yaml_number(simulation.rate), "Hz");
  out.entry("duration", yaml_number(simulation.duration), "s");
  out.entry("seed", fmt::format("{}", simulation.seed));
  out.open("excitation");
  out.open(to_string(simulation.excitation.kind));
  simulation.excitation.fields(fields);
  out.close();
  out.close();
  out.open("initial");
  simulation.initial.fields(fields);
  out.close();
  out.quantity("noise", yaml_number(simulation.noise), "rad");
  out.entry("plant", simulation.independent ? "independent" : "simulator");
  write_plant(out, simulation.plant, coordinates);
  out.close();
}

void write_detector(YamlWriter& out, const DetectorConfig& detector) {
  out.open("detector");
  out.entry("method", to_string(detector.method));
  if (detector.from_model) {
    out.open("bound");
    out.open("from_model");
    out.entry("input_limit", yaml_number(detector.from_model->input_limit), "unit of u");
    out.quantity("load_force_bound", yaml_number(detector.from_model->load_force_bound), "N m");
    out.close();
    out.close();
  } else {
    out.quantity("bound", detector.bound ? yaml_number(*detector.bound) : "auto",
                 detector.bound ? "rad/s^2" : "");
  }
  if (detector.literal) out.quantity("literal", yaml_number(*detector.literal), "rad/s^2");
  out.close();
}

void write_encoder(YamlWriter& out, const EncoderConfig& encoder) {
  std::vector<std::string> parts;
  if (encoder.bits)
    parts.push_back(fmt::format("bits: {}", *encoder.bits));
  else if (encoder.quantum > 0.0)
    parts.push_back(fmt::format("quantum: {}", encoder.quantum));
  if (encoder.sides != EncoderSides::kMotor)
    parts.push_back(fmt::format("side: {}", to_string(encoder.sides)));
  if (parts.empty()) return;
  if (encoder.bits)
    out.entry("encoder", "{" + joined(parts) + "}");
  else
    out.quantity("encoder", "{" + joined(parts) + "}", encoder.quantum > 0.0 ? "rad" : "");
}

void write_reading(YamlWriter& out, const Configuration& c) {
  if (c.recording) write_recording(out, *c.recording);
  if (c.simulation) write_simulation(out, *c.simulation, c.coordinates);
  write_encoder(out, c.encoder);
  const bool supplied = (c.simulation && !c.simulation->excitation.voltage_column.empty()) ||
                        (c.recording && c.recording->is_supplied());
  const std::string unit = internal::config::controller_output_unit(
      supplied, internal::config::gain_is_torque(c), c.recording ? c.recording->units : DeclaredUnits{},
      c.coordinates);
  if (c.controller)
    internal::config::write_controller(out, *c.controller, unit);
  else if (c.recording && c.recording->reading.controller)
    internal::config::write_controller(out, ControllerModel::known(*c.recording->reading.controller), unit);
  out.entry("coordinates", c.coordinates.name());
}

void write_implant(YamlWriter& out, ImplantConfig implant) {
  FieldWriter fields(out);
  out.open("implant");
  implant.fields(fields);
  if (!implant.effects.empty()) out.entry("effects", "[" + joined(implant.effects) + "]");
  out.close();
}

}  // namespace

std::string resolved_reading(const Configuration& c) {
  YamlWriter out(c.coordinates);
  write_reading(out, c);
  return out.text();
}

std::string resolved_yaml(const Configuration& c) {
  return yaml_of(
      c, "The configuration of this report, every default filled in; paths are those of the original.");
}

std::string yaml_of(const Configuration& c, const std::string& heading) {
  FitOptions fit = c.fit;
  ExperimentLimits limits = c.next_experiment;
  DiagnosisKnowledge known = c.diagnosis;
  YamlWriter out(c.coordinates);
  if (!heading.empty()) out.comment(heading);
  out.entry("name", yaml_text(c.name));
  write_reading(out, c);
  write_model(out, c.model, c.coordinates);
  if (c.anchor) internal::config::write_anchor(out, *c.anchor);
  write_detector(out, c.detector);
  FieldWriter fields(out);
  out.open("fit");
  fit.fields(fields);
  out.close();
  out.open("next_experiment");
  limits.fields(fields);
  out.close();
  out.open("diagnosis");
  known.fields(fields);
  if (!c.excluded.empty()) out.entry("exclude", "[" + joined(c.excluded) + "]");
  out.close();
  Tolerance tolerance = c.tolerance;
  if (tolerance.stated()) {
    out.open("tolerance");
    tolerance.fields(fields);
    out.close();
  }
  if (c.implant) write_implant(out, *c.implant);
  return out.text();
}

}  // namespace gapscope
