#include "config/starter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/plain_name.h"
#include "base/shown.h"
#include "config/controller_reader.h"
#include "config/data_reader.h"
#include "config/starter_choice.h"
#include "config/starter_motor.h"
#include "config/units_reader.h"
#include "config/yaml_writer.h"
#include "gapscope/inspection/inspection.h"

namespace gapscope {
namespace {

using internal::config::anchor_comment;
using internal::config::anchor_text;
using internal::config::as_modelled;
using internal::config::Begin;
using internal::config::chosen_structure;
using internal::config::fit_to_structure;
using internal::config::hanging_told;
using internal::config::order_told;
using internal::config::StarterChoice;
using internal::config::suggest_anchor;
using internal::config::take_constant;
using internal::config::write_effects;
using internal::config::write_estimated;
using internal::config::write_motor;
using internal::config::yaml_text;
using internal::config::YamlWriter;

/// Two digits, not above: a rate that the recording has.
double round_down(double rate) {
  const double unit = std::pow(10.0, std::floor(std::log10(rate)) - 1.0);
  return std::floor(rate / unit * (1.0 + 1e-9)) * unit;
}

double largest_input(const std::vector<Recording>& recordings) {
  double largest = 0.0;
  for (const Recording& r : recordings)
    for (const double v : r.u) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Of the recordings whose number is one.
double median_of(const std::vector<Inspection>& seen, double RecordingFacts::*number) {
  std::vector<double> values;
  for (const Inspection& i : seen)
    if (std::isfinite(i.facts.*number)) values.push_back(i.facts.*number);
  return values.empty() ? kNaN : median(std::move(values));
}

/// What all recordings tell of one drive: the finest step, the lowest rate, of the rest the middle.
RecordingFacts facts_of_all(const std::vector<Inspection>& seen) {
  RecordingFacts all = seen.front().facts;
  for (const Inspection& i : seen) {
    all.uniform = all.uniform && i.facts.uniform;
    all.rate = std::min(all.rate, i.facts.rate);
    if (!(all.quantum <= i.facts.quantum)) all.quantum = i.facts.quantum;
  }
  for (const auto number : {&RecordingFacts::inertia, &RecordingFacts::damping, &RecordingFacts::friction,
                            &RecordingFacts::hangs_at})
    all.*number = median_of(seen, number);
  return all;
}

/// A name that a folder may have.
std::string plain_name(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string().substr(0, 100);
  for (char& c : name)
    if (!is_plain_name("a" + std::string(1, c))) c = '_';
  return is_plain_name(name) ? name : "drive_" + name.substr(0, 90);
}

/// The recording as it is named in a configuration of that folder.
std::string named_from(const std::string& folder, const std::string& recording) {
  const bool stays = std::filesystem::path(recording).is_absolute() || std::filesystem::path(folder) == ".";
  return stays ? recording : std::filesystem::proximate(recording, folder).generic_string();
}

/// One file, or the list of several.
std::string files_text(const std::string& folder, const std::vector<RecordedFile>& files) {
  std::vector<std::string> names;
  for (const RecordedFile& file : files) names.push_back(yaml_text(named_from(folder, file.path)));
  return names.size() == 1 ? names.front() : fmt::format("[{}]", fmt::join(names, ", "));
}

void write_recording(YamlWriter& out, const std::string& folder, const RecordingConfig& recording,
                     bool resampled, const std::string& order) {
  const ReadOptions& options = recording.reading;
  out.open("recording");
  if (!order.empty()) out.comment(order);
  out.entry("file", files_text(folder, recording.files));
  if (!recording.held_out.empty())
    out.entry("held_out", files_text(folder, recording.held_out), "for diagnose");
  else
    out.comment(
        "held_out: another.csv   # a second recording of this drive, for diagnose; else the last third");
  for (const Remark& r : recording.assumed) out.comment("assumed: " + r.text());
  out.entry("columns", internal::config::columns_text(options.columns));
  internal::config::write_rows(out, options);
  internal::config::write_units(out, recording);
  if (options.window)
    out.entry("window", fmt::format("[{}, {}]", options.window->first, options.window->second),
              recording.held_out.empty() ? "s" : "s, of each file, held_out as well");
  if (options.resample_rate)
    out.entry("resample",
              fmt::format("{{rate: {}{}}}", *options.resample_rate, resampled ? ", for: detector" : ""),
              resampled ? "Hz; time is not uniform: fit and diagnose use it as it is" : "Hz");
  out.close();
}

/// @param gear  between the encoder and x1
void write_encoder(YamlWriter& out, const EncoderConfig& known, RecordingFacts f, double gear,
                   Coordinates coordinates) {
  const char* const side = known.sides == EncoderSides::kLoad ? ", side: load" : "";
  if (known.bits) return out.entry("encoder", fmt::format("{{bits: {}{}}}", *known.bits, side), "as given");
  f.quantum *= std::abs(gear);
  if (std::isnan(f.quantum) && *side != '\0') return out.entry("encoder", "{side: load}", "no step is seen");
  if (std::isnan(f.quantum))
    return out.comment(coordinates.rotational()
                           ? "encoder: {bits: 20}   # GUESS: no step is seen in x1; what the sheet says"
                           : "encoder: {quantum: 1e-6}   # GUESS: no step is seen in x1; m");
  const double bits = std::log2(2.0 * std::numbers::pi / f.quantum);
  const bool binary = coordinates.rotational() && std::abs(bits - std::round(bits)) < 1e-3;
  out.entry("encoder",
            binary ? fmt::format("{{bits: {:.0f}{}}}", bits, side)
                   : fmt::format("{{quantum: {:.5g}{}}}", f.quantum, side),
            fmt::format("read: {} steps by {:.5g} {}", gear == 1.0 ? "x1" : "the encoder", f.quantum,
                        coordinates.position_unit()));
}

/// The controller that makes the input of the target.
void write_commanding(YamlWriter& out, const RecordingConfig& recording, bool sought,
                      Coordinates coordinates) {
  ControllerModel model = ControllerModel::known(*recording.reading.controller);
  model.rate_sought = !(model.fixed.rate > 0.0);
  if (sought)
    model.numbers[static_cast<std::size_t>(leading_number(model.fixed.kind))] = ParameterSetting::sought();
  internal::config::write_controller(
      out, model,
      internal::config::controller_output_unit(recording.is_supplied(),
                                               sought && !std::isfinite(model.fixed.saturation),
                                               recording.units, coordinates));
}

bool was_unwrapped(const std::vector<Remark>& assumed) {
  return std::any_of(assumed.begin(), assumed.end(),
                     [](const Remark& r) { return r.code() == "position.unwrapped"; });
}

Begin begin_of(const RecordingFacts& f, bool one_body, const std::optional<JointNumbers>& nominal) {
  Begin begin;
  if (nominal) {
    begin.numbers = *nominal, begin.from = "of joint " + printable(nominal->joint, 40), begin.nominal = true;
    return begin;
  }
  begin.from = "read, as one body";
  if (one_body && f.inertia > 0.0)  // else the recording is no single body's, and says nothing of the others
    begin.numbers.inertia = f.inertia, begin.numbers.damping = f.damping, begin.numbers.friction = f.friction;
  return begin;
}

/// Whether u is declared as what drives x1, in N m or N; a gear between the two makes another torque of it.
bool is_drive_torque(const RecordingConfig& r, Coordinates coordinates) {
  const bool turns = coordinates.rotational();
  const std::string unit = si_unit(turns ? Quantity::kTorque : Quantity::kForce, r.units.input);
  return unit == (turns ? "N m" : "N") && r.gear.position == 1.0;
}

/// A gear of 1 is what a simulator's file has that says nothing of its motor: beside an input that is no
/// torque it is a guess.
void doubt_the_gear(const RecordingConfig& recording, Coordinates coordinates, JointNumbers& n) {
  constexpr double kRounding = 1e-12;
  const std::string& unit = recording.units.input;
  const bool is_torque = unit.empty() || is_drive_torque(recording, coordinates);
  if (is_torque || !(std::abs(n.torque_constant - 1.0) < kRounding)) return;
  n.torque_constant = kNaN;
  n.notes.push_back(fmt::format(
      "torque_constant is a GUESS: {} has a gear of 1 for joint {}, but the input is in {}, not in {}",
      printable(n.model, 80), printable(n.joint, 40), printable(unit, 20), coordinates.torque_unit()));
}

void write_load(YamlWriter& out, const StarterChoice& choice, const Begin& begin, Coordinates coordinates) {
  const bool free = choice.structure == StarterModel::kGap;
  const JointNumbers& n = begin.numbers;
  const auto estimated = [&](const char* key, double value, const std::string& unit) {
    write_estimated(out, key, value, unit, begin);
  };
  if (free) estimated("mass_ratio", n.load_inertia / n.inertia, "load over motor");
  estimated("gap", n.gap,
            (choice.seen ? "" : "GUESS that there is one; ") + std::string(coordinates.position_unit()));
  if (free) estimated("load_damping", n.load_damping, coordinates.unit("N m s/rad"));
  if (free) estimated("load_coulomb_friction", n.load_friction, coordinates.torque_unit());
  estimated("contact_stiffness", n.stiffness, coordinates.unit("N m/rad"));
  estimated("contact_damping", n.contact_damping, coordinates.unit("N m s/rad"));
}

void write_model(YamlWriter& out, const StarterChoice& choice, const Begin& begin, Coordinates coordinates) {
  const bool load = choice.structure != StarterModel::kOneBody, free = choice.structure == StarterModel::kGap;
  out.open("model");
  out.comment(choice.why);
  for (const std::string& note : begin.numbers.notes) out.comment(note);
  if (!choice.seen)
    out.comment(std::string(load ? "no gap in this drive: gapscope init --model one_body"
                                 : "a gap in this drive: gapscope init --model gap") +
                "; for an output that is held: --model locked");
  if (load) out.entry("contact", "compliant");
  if (load) out.entry("load", free ? "free" : "locked");
  out.open("parameters");
  write_motor(out, begin, coordinates);
  if (!load)
    out.entry("mass_ratio", "0",
              "one body; for a drive with a gap: {estimate: true}, and gap, contact_stiffness alike");
  if (load) write_load(out, choice, begin, coordinates);
  out.close();
  write_effects(out, begin, coordinates);
  out.close();
}

std::string head(bool guesses, Coordinates coordinates) {
  YamlWriter out(coordinates);
  out.comment(guesses
                  ? "A first configuration, read off the recording. What is marked GUESS it does not show: "
                    "put in what the sheet says."
                  : "A first configuration, read off the recording.");
  out.comment("A bare number is fixed; {estimate: true} is fitted, from a value if one is given.");
  return out.text();
}

/// As `check` looks at it, with what the declared unit of the input says.
Inspection inspected(const RecordingConfig& config, const std::string& path, const ReadOptions& options,
                     Coordinates coordinates) {
  Inspection seen = inspect(path, options, coordinates);
  const bool recorded = options.columns.reads_input() && options.columns.voltage.empty();
  const Quantity torque = coordinates.rotational() ? Quantity::kTorque : Quantity::kForce;
  judge_for_unit(recorded ? si_unit(torque, config.units.input) : "", seen);
  return seen;
}

/// Of notes that are worth a warning, of what is fitted and what is held out alike.
void warn_of_notes(const RecordingConfig& config, const RecordedFile& file, Coordinates coordinates,
                   Starter& starter) {
  for (const Finding& f :
       inspected(config, file.path, config.reading_of(file, UnevenRows::kStamped), coordinates).findings)
    if (f.warned)
      starter.spoiling.push_back(fmt::format("{}: {}: {} -> {}", file.given, f.rule, f.found, f.advice));
}

}  // namespace

Starter starter_configuration(RecordingConfig config, const EncoderConfig& encoder, Coordinates coordinates,
                              const std::string& folder, const StarterKnowledge& known) {
  const std::optional<JointNumbers>& nominal = known.nominal;
  ReadOptions& options = config.reading;
  std::vector<Inspection> seen;
  for (const RecordedFile& file : config.files) {
    seen.push_back(inspected(config, file.path, options, coordinates));
    judge_for_encoder(internal::config::position_quantum(encoder, config), config.units.position == "counts",
                      seen.back());
    if (encoder.sides == EncoderSides::kLoad) judge_for_load_encoder(seen.back());
    if (known.model == StarterModel::kLocked) judge_for_locked_output(seen.back());
  }
  const RecordingFacts facts = facts_of_all(seen);
  const bool irregular = !options.resample_rate && !facts.uniform;
  if (irregular) options.resample_rate = round_down(facts.rate);
  std::vector<Recording> recordings;
  std::vector<MotorTrace> traces;
  for (const RecordedFile& file : config.files) recordings.push_back(read_recording(file.path, options));
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  const EncoderSide side = recordings.front().encoder;
  const StarterChoice choice = nominal && known.model == StarterModel::kAsSeen
                                   ? as_modelled(*nominal, traces, side, coordinates)
                                   : chosen_structure(known.model, traces, side, coordinates);
  const bool one_body = choice.structure == StarterModel::kOneBody;
  if (one_body && choice.seen)  // nobody asks the detector
    for (Inspection& i : seen) judge_for(Purpose::kDiagnosis, i);
  Starter starter;
  starter.model = choice.why;
  starter.assumed = config.assumed;
  starter.assumed.insert(starter.assumed.end(), seen.front().assumed.begin(), seen.front().assumed.end());
  if (options.unwrap == Unwrap::kAuto &&
      std::ranges::any_of(seen, [](const Inspection& i) { return was_unwrapped(i.assumed); }))
    options.unwrap = Unwrap::kAlways;
  if (!choice.seen && choice.structure != StarterModel::kOneBody)
    starter.model += "; where there is none, --model one_body is the quicker model";
  if (config.files.size() == 1 && !config.held_out.empty())
    starter.order = order_told(config, known.options, coordinates);
  for (const auto* files : {&config.files, &config.held_out})
    for (const RecordedFile& file : *files) warn_of_notes(config, file, coordinates, starter);
  YamlWriter out(coordinates);
  for (const Inspection& i : seen)
    for (const Finding& f : i.findings) {
      const bool settled = f.rule == kTimeRule && irregular;
      if (f.severity != Severity::kSpoils || settled) continue;
      const std::string which = seen.size() > 1 ? printable(i.file, 200) + ": " : "";
      starter.spoiling.push_back(which + f.rule + ": " + f.found + " -> " + f.advice);
      out.comment("SPOILS THE ESTIMATES, " + starter.spoiling.back());
    }
  const std::string& named = !known.name.empty() ? known.name
                             : nominal           ? nominal->joint
                                                 : config.files.front().path;
  out.entry("name", plain_name(named), "of the report: reports/<name>");
  write_recording(out, folder, config, irregular, starter.order);
  write_encoder(out, encoder, facts, config.gear.position, coordinates);
  if (config.reading.controller) write_commanding(out, config, known.gain_sought, coordinates);
  out.entry("coordinates", coordinates.name());
  Begin begin = begin_of(facts, one_body, nominal);
  if (nominal) doubt_the_gear(config, coordinates, begin.numbers);
  begin.input_is_torque = !(begin.numbers.torque_constant > 0.0) && is_drive_torque(config, coordinates);
  begin.gain_sought = known.gain_sought && !std::isfinite(config.reading.controller->saturation);
  if (known.torque_constant > 0.0)
    take_constant(begin, known.torque_constant, std::abs(config.gear.position));
  begin.motor_inertia = known.motor_inertia, begin.one_body = one_body;
  begin.anchored = known.anchor.has_value();
  begin.knows_inertia = begin.anchored && (std::isfinite(known.anchor->inertia) ||
                                           (one_body && std::isfinite(known.anchor->mass)));
  const bool rubs_as_anchored = begin.anchored && std::isfinite(known.anchor->friction);
  if (rubs_as_anchored) begin.numbers.friction = kNaN;
  begin.friction_sought = !one_body && !nominal && !rubs_as_anchored;
  begin.largest_input = largest_input(recordings),
  begin.geared = config.gear.position != config.gear.load_position;
  doubt_the_control(begin, coordinates);
  fit_to_structure(begin, choice.structure);
  write_model(out, choice, begin, coordinates);
  starter.remarks = begin.numbers.notes;
  out.entry("detector", "{bound: auto}");
  const double hangs_at = facts.hangs_at;
  if (known.anchor)
    out.entry("anchor", anchor_text(*known.anchor, hangs_at), anchor_comment(*known.anchor, hangs_at));
  else if (!begin.settled())
    suggest_anchor(out, begin.gain_sought, coordinates);
  if (known.anchor) starter.hangs = hanging_told(*known.anchor, hangs_at);
  starter.guesses = out.text().find("GUESS") != std::string::npos;
  starter.yaml = head(starter.guesses, coordinates) + out.text();
  return starter;
}

}  // namespace gapscope
