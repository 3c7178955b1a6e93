#include "config/data_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "base/shown.h"
#include "config/field_reader.h"
#include "config/file_facts.h"
#include "config/units_reader.h"
#include "recording/column_name.h"

namespace gapscope {

void InitialState::fields(FieldVisitor& v) {
  v.field({"x1", "rad", "motor position", -1e6, 1e6}, x1);
  v.field({"w1", "rad/s", "motor speed", -1e6, 1e6}, w1);
  v.field({"x2", "rad", "load position", -1e6, 1e6}, x2);
  v.field({"w2", "rad/s", "load speed", -1e6, 1e6}, w2);
}

ReadOptions RecordingConfig::reading_for(UnevenRows uneven) const {
  ReadOptions options = reading;
  options.uneven = uneven;
  if (options.encoder == EncoderSide::kLoad) options.columns = reading.columns.read_from_load();
  if (resample_for_detector && uneven == UnevenRows::kStamped) options.resample_rate.reset();
  return options;
}

ReadOptions RecordingConfig::reading_of(const RecordedFile& file, UnevenRows uneven) const {
  ReadOptions options = reading_for(uneven);
  options.gain_times = file.gain_times;
  if (file.window) options.window = file.window;
  options.off = file.off;
  if (!std::isnan(file.voltage)) options.voltage = file.voltage;
  return options;
}

bool RecordingConfig::is_supplied() const {
  return !reading.columns.voltage.empty() ||
         std::ranges::any_of(files, [](const RecordedFile& file) { return !std::isnan(file.voltage); });
}

namespace {

/// Wherever a relative one begins.
std::string whole_path(const RecordedFile& file) {
  return std::filesystem::absolute(file.path).lexically_normal().string();
}

}  // namespace

std::string RecordingConfig::simulated_problem() const {
  std::set<std::string> taken;
  for (const auto* recorded : {&files, &held_out})
    for (const RecordedFile& file : *recorded) taken.insert(whole_path(file));
  for (const RecordedFile& file : simulated)
    if (!taken.insert(whole_path(file)).second)
      return fmt::format(
          "names {}, which is named already, expected a file of its own with what the "
          "simulator answers to each recording",
          file.given);
  if (simulated.empty() || simulated.size() == files.size() ||
      (!held_out.empty() && simulated.size() == files.size() + held_out.size()))
    return "";
  return fmt::format(
      "names {} file{}, expected one for each of recording: file ({}){}", simulated.size(),
      simulated.size() == 1 ? "" : "s", files.size(),
      held_out.empty() ? "" : fmt::format(", and for each of held_out ({}) behind them", held_out.size()));
}

std::size_t SimulationConfig::samples() const {
  return static_cast<std::size_t>(std::llround(rate * duration));
}

namespace internal::config {
namespace {

const std::vector<std::string> kSimulationKeys = {"rate",    "duration", "seed",  "excitation",
                                                  "initial", "noise",    "plant", "model"};

void read_column(const Section& section, const char* key, std::string& name, std::set<std::string>& taken) {
  const auto given = section.find(key);
  if (given) name = given->text();
  if (!taken.insert(name).second)
    (given ? *given : section.value())
        .fail(fmt::format("uses the column {} twice, expected each column once", name));
}

RecordingColumns read_columns(const Value& value, RecordingConfig& recording) {
  const Section section(value, {"time", "input", "position", "load_position", "voltage", "target", "speed",
                                "mass", "arm", "gain"});
  RecordingColumns columns;
  std::set<std::string> taken;
  read_column(section, "time", columns.time, taken);
  read_column(section, "input", columns.input, taken);
  if (says_temperature(columns.input))
    section.find("input")->fail(
        fmt::format("is {}, a temperature by its name, expected {}", shown(columns.input), kInputsOfDrives));
  const auto speed = section.find("speed");
  if (speed && section.find("position"))
    speed->fail(
        "stands beside position, expected one of the two: x1 is measured, or the integral of the speed");
  columns.position_is_speed = speed.has_value();
  read_column(section, speed ? "speed" : "position", columns.position, taken);
  read_column(section, "load_position", columns.load_position, taken);
  columns.load_position_required = section.find("load_position").has_value();
  columns.position_named = speed || section.find("position");
  if (section.find("voltage")) read_column(section, "voltage", columns.voltage, taken);
  if (section.find("target")) read_column(section, "target", columns.target, taken);
  for (const auto& [key, name] : {std::pair{"mass", &recording.mass_column},
                                  {"arm", &recording.arm_column},
                                  {"gain", &recording.gain_column}})
    if (section.find(key)) read_column(section, key, *name, taken);
  if (!columns.target.empty() && !section.find("input")) columns.input_column = InputColumn::kNone;
  return columns;
}

Excitation read_excitation(const Value& value, const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& spec : excitation_kinds()) names.emplace_back(spec.name);
  const Section section(value, names);
  std::optional<Excitation> excitation;
  for (const auto& spec : excitation_kinds()) {
    const auto given = section.find(spec.name);
    if (!given) continue;
    if (excitation) given->fail("is a second excitation, expected exactly one");
    excitation.emplace();
    excitation->kind = spec.kind;
    excitation->folder = folder;
    read_fields(*given, *excitation);
  }
  if (!excitation) value.fail_expecting(fmt::format("one of {}", fmt::join(names, ", ")));
  return *excitation;
}

void require_sensible_size(const SimulationConfig& s, const Section& section) {
  const double samples = s.rate * s.duration;
  if (samples > kMostSimulatedSamples)
    section.value().fail(fmt::format("gives rate x duration = {:.6g} samples, expected at most {:.0f}",
                                     samples, kMostSimulatedSamples));
  if (s.samples() < kFewestSamples)
    section.value().fail(
        fmt::format("gives rate x duration = {:.6g} samples, expected at least {}", samples, kFewestSamples));
}

void read_resampling(const Value& value, RecordingConfig& recording) {
  const Section section(value, {"rate", "for"});
  recording.reading.resample_rate = section.require("rate", "a number [Hz]").number({1e-3, 1e7, "Hz"});
  if (const auto who = section.find("for"))
    recording.resample_for_detector = who->word({"all", "detector"}) == 1;
}

}  // namespace

RecordingConfig read_recording_block(const Value& value, const std::string& folder,
                                     const EncoderConfig& encoder, Coordinates coordinates) {
  const Section section(
      value, {"file", "held_out", "simulated", "columns", "units", "registers", "gear_ratio", "window",
              "resample", "lost_rows", "rate", "unwrap", "input_rows"});
  RecordingConfig recording;
  recording.files = read_files(section.require("file", "a file or a list of files"), folder, {});
  if (const auto held_out = section.find("held_out"))
    recording.held_out = read_files(*held_out, folder, recording.files);
  recording.reading.encoder = encoder.side();
  if (const auto simulated = section.find("simulated")) {
    recording.simulated = read_simulated_files(*simulated, folder);
    if (const std::string problem = recording.simulated_problem(); !problem.empty()) simulated->fail(problem);
  }
  if (const auto columns = section.find("columns"))
    recording.reading.columns = read_columns(*columns, recording);
  if (const auto rate = section.find("rate")) recording.reading.columns.rate = rate->number(kRowRates);
  if (const auto unwrap = section.find("unwrap"))
    recording.reading.unwrap = static_cast<Unwrap>(unwrap->word({"auto", "true", "false"}));
  if (const auto rows = section.find("input_rows"))
    recording.reading.input_rows = static_cast<int>(rows->integer(-kMostInputRows, kMostInputRows));
  if (encoder.sides == EncoderSides::kBoth) recording.reading.columns.load_position_required = true;
  read_units(section, encoder, coordinates, recording);
  if (const auto window = section.find("window")) recording.reading.window = window->rising_pair(kWindow);
  if (const auto lost = section.find("lost_rows"))
    recording.reading.lost_rows = static_cast<LostRows>(lost->word({"held", "bridged"}));
  if (const auto resample = section.find("resample")) read_resampling(*resample, recording);
  read_facts_of_files(recording);
  return recording;
}

double position_quantum(const EncoderConfig& encoder, const RecordingConfig& recording) {
  const bool load =
      encoder.sides == EncoderSides::kLoad && recording.reading.columns.load_reads_load_position();
  return encoder.quantum / std::abs(load ? recording.gear.load_position : recording.gear.position);
}

EncoderConfig read_encoder(const Value& value, Coordinates coordinates) {
  const Section section(value, {"bits", "quantum", "counts", "side"});
  const auto bits = section.find("bits"), quantum = section.find("quantum"), counts = section.find("counts"),
             side = section.find("side");
  EncoderConfig encoder;
  encoder.line = side ? side->line() : value.line();
  if (side) encoder.sides = static_cast<EncoderSides>(side->word({"motor", "load", "both"}));
  if (counts && (bits || quantum)) counts->fail("stands beside bits or quantum, expected one of the three");
  if (side && !bits && !quantum && !counts) return encoder;
  if (!counts && bits.has_value() == quantum.has_value())
    value.fail(fmt::format("has {} of bits and quantum, expected exactly one", bits ? "both" : "neither"));
  if (!quantum && !coordinates.rotational())
    (bits ? *bits : *counts).fail("counts a revolution, expected quantum [m] with coordinates: translation");
  if (quantum) {
    encoder.quantum = quantum->number({1e-15, 10.0, coordinates.position_unit()});
  } else if (counts) {
    encoder.quantum = 2.0 * kPi / counts->number({1.0, 1e12, "per turn"});
  } else {
    encoder.bits = static_cast<int>(bits->integer(1, 40));
    encoder.quantum = EncoderConfig::quantum_of(*encoder.bits);
  }
  return encoder;
}

SimulationConfig read_simulation(const Value& value, const std::string& folder) {
  const Section section(value, kSimulationKeys);
  SimulationConfig s;
  s.line = value.line();
  s.rate = section.require("rate", "the sampling rate [Hz]").number({1e-3, 1e7, "Hz"});
  s.duration = section.require("duration", "the duration [s]").number({1e-6, 1e8, "s"});
  require_sensible_size(s, section);
  if (const auto seed = section.find("seed")) s.seed = seed->natural(~std::uint64_t{0});
  const Value excitation = section.require("excitation", "e.g. sine: {amplitude: 0.5, frequency: 1}");
  s.excitation = read_excitation(excitation, folder);
  if (const std::string problem = excitation_problem(s.excitation, s.rate, s.duration); !problem.empty())
    excitation.fail(std::string(to_string(s.excitation.kind)) + ": " + problem);
  if (const auto initial = section.find("initial")) read_fields(*initial, s.initial);
  if (const auto noise = section.find("noise")) s.noise = noise->number({0.0, 1e3, "rad"});
  if (const auto plant = section.find("plant"))
    s.independent = plant->word({"simulator", "independent"}) == 1;
  return s;
}

std::optional<Value> simulated_model(const Value& value) {
  return Section(value, kSimulationKeys).find("model");
}

}  // namespace internal::config
}  // namespace gapscope
