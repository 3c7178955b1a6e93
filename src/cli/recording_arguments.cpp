// The options of the commands that are given a recording itself, before there is a configuration.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>

#include "base/move_file.h"
#include "base/shown.h"
#include "cli/commands.h"
#include "cli/presets.h"
#include "commands/axis.h"
#include "gapscope/base/errors.h"
#include "recording/axes.h"
#include "recording/column_name.h"

namespace gapscope::cli {

EncoderConfig RecordingArguments::encoder() const {
  EncoderConfig encoder;
  if (bits > 0) encoder.bits = bits, encoder.quantum = EncoderConfig::quantum_of(bits);
  if (side == "load") encoder.sides = EncoderSides::kLoad;
  return encoder;
}

namespace {

/// The controller with numbers that are set as in a configuration; its gain is told apart.
/// @throws ConfigError "--set KEY: ..."
DriveController controller_with(const std::vector<std::string>& set) {
  std::vector<Setting> settings;
  for (const std::string& text : set) {
    settings.push_back(read_setting(text));
    if (!settings.back().key.starts_with("controller."))
      throw ConfigError(
          fmt::format("gapscope: --set {} is of no controller, expected controller.KEY=VALUE: the rest of a "
                      "configuration is written into its file",
                      shown(settings.back().key)));
  }
  DriveController controller;
  if (settings.empty()) return controller;
  telling_settings(settings, [&] {
    controller = parse_configuration(
                     "name: servo\nrecording: {file: servo.csv, columns: {target: goal}}\ncontroller: "
                     "{position: {gain: 1}}\n"
                     "model: {parameters: {motor_inertia: 1, torque_constant: 1, mass_ratio: 0}}\n",
                     "--set", settings)
                     .controller->at_start();
  });
  return controller;
}

}  // namespace

std::optional<DriveController> RecordingArguments::commanding() const {
  if (!set.empty() && (target.empty() || (gain.empty() && of_model)))
    throw ConfigError(
        fmt::format("gapscope: --set {} is of a controller that is not declared here, expected --target and "
                    "--controller-gain beside it",
                    shown(set.front())));
  if (target.empty() && gain.empty()) return {};
  if (target.empty())
    throw ConfigError(
        "gapscope: --controller-gain is given without --target, expected the column of the commanded "
        "position beside it");
  if (gain.empty() && of_model) return of_model;
  if (gain.empty())
    throw ConfigError(
        "gapscope: --target is given without --controller-gain, expected the gain of the servo's position "
        "controller beside it, or --controller-gain estimate where nobody knows it");
  DriveController c = controller_with(set);
  c.gain = decimal(gain).value_or(1.0);  // one that is sought begins there
  return c;
}

namespace {

struct NamedUnit {
  std::string* declared;
  std::string column;
  Quantity quantity;
};

/// The units that may be left to the names of columns.
std::vector<NamedUnit> left_to_names(DeclaredUnits& units, const RecordingColumns& columns,
                                     Coordinates coordinates) {
  const bool turns = coordinates.rotational();
  const bool speed = columns.position_is_speed;
  std::vector<NamedUnit> left = {{&units.input, columns.input, turns ? Quantity::kTorque : Quantity::kForce},
                                 {speed ? &units.speed : &units.position, columns.position,
                                  speed   ? (turns ? Quantity::kTurning : Quantity::kSliding)
                                  : turns ? Quantity::kAngle
                                          : Quantity::kLength},
                                 {&units.voltage, columns.voltage, Quantity::kVoltage}};
  if (columns.rate == 0.0) left.insert(left.begin(), {&units.time, columns.time, Quantity::kTime});
  std::erase_if(left, [](const NamedUnit& u) { return !u.declared->empty(); });
  return left;
}

}  // namespace

namespace {

/// The option that says the unit of a column.
std::string option_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kTime:
      return "--time-unit";
    case Quantity::kTorque:
    case Quantity::kForce:
      return "--input-unit";
    case Quantity::kVoltage:
      return "--voltage-unit";
    case Quantity::kTurning:
    case Quantity::kSliding:
      return "--speed-unit";
    case Quantity::kAngle:
    case Quantity::kLength:
      break;
  }
  return "--position-unit";
}

/// @throws ConfigError where the name ends with what is no unit of this quantity
std::string unit_by_name(const NamedUnit& u) {
  const std::string unit = unit_in_name(u.column, u.quantity), other = unit_of_another(u.column, u.quantity);
  if (other.empty()) return unit;
  const bool speed = unit_scale(Quantity::kTurning, other) || unit_scale(Quantity::kSliding, other);
  throw ConfigError(
      fmt::format("gapscope: {} is in {}, which is {}, expected {} with {}", shown(u.column), shown(other),
                  speed ? "a speed" : "no known unit here",
                  speed ? fmt::format("--speed {} (or {} UNIT", u.column, option_of(u.quantity)) + ")"
                        : option_of(u.quantity),
                  known_units(u.quantity)));
}

/// Of "16", "sign10" or "offset2048".
RegisterForm register_form(const std::string& text) {
  const auto number = [&](const std::string& word, double low, double high) -> std::optional<double> {
    if (!text.starts_with(word)) return {};
    const auto value = decimal(text.substr(word.size()));
    return value && *value >= low && *value <= high ? value : std::nullopt;
  };
  RegisterForm form;
  if (text.empty()) return form;
  if (const auto bit = number("sign", 1, 51))
    form.sign_bit = static_cast<int>(*bit);
  else if (const auto offset = number("offset", -1e15, 1e15))
    form.offset = *offset;
  else if (const auto bits = number("", 2, 52))
    form.bits = static_cast<int>(*bits);
  else
    throw ConfigError(
        fmt::format("gapscope: --input-register is {}, expected bits of two's complement (2 to 52), signBIT "
                    "(1 to 51) or offsetNUMBER",
                    shown(text)));
  return form;
}

}  // namespace

std::string RecordingArguments::told_by_names() const {
  const RecordingConfig c = configuration();
  DeclaredUnits given = units;
  std::vector<std::string> told;
  for (const NamedUnit& u : left_to_names(given, c.reading.columns, coordinates())) {
    const std::string unit = unit_in_name(u.column, u.quantity);
    if (!unit.empty()) told.push_back(fmt::format("{} in {}", shown(u.column), unit));
  }
  return told.empty()
             ? ""
             : fmt::format(
                   "{}, by the names of the columns (--time-unit, --position-unit, ... say otherwise)",
                   fmt::join(told, ", "));
}

RecordingConfig RecordingArguments::configuration() const {
  RecordingConfig c;
  c.files = {{file, file, 0}};
  c.registers = registers;
  if (!input_register.empty()) c.registers.input = register_form(input_register);
  c.gear = gear;
  c.assumed = guessed;
  ReadOptions& o = c.reading;
  o.columns.time = time;
  const std::string named = axis.empty() ? "" : std::string(kAxisInName) + ".";  // as of joint states
  o.columns.input = !input.empty() ? input : axis.empty() ? "u" : named + "effort";
  o.encoder = encoder().side();
  o.columns.position = !position.empty()                 ? position
                       : !axis.empty()                   ? named + "position"
                       : o.encoder == EncoderSide::kLoad ? "x2"
                                                         : "x1";
  if (!speed.empty()) o.columns.position = speed, o.columns.position_is_speed = true;
  o.columns.position_named = true;
  o.columns.rate = rate;
  o.input_rows = input_rows;
  o.columns.voltage = voltage;
  o.columns.target = target;
  if (!target.empty() && input.empty()) o.columns.input_column = InputColumn::kNone;
  o.controller = commanding();
  if (!axis.empty() && axis != kAllAxes) o.columns = columns_of_axis(o.columns, axis);
  if (says_temperature(o.columns.input))
    throw ConfigError(fmt::format("gapscope: --input is {}, a temperature by its name, expected {}",
                                  shown(o.columns.input), kInputsOfDrives));
  require_three_columns(o.columns);
  c.units = units;
  for (const NamedUnit& u : left_to_names(c.units, o.columns, coordinates())) *u.declared = unit_by_name(u);
  if (c.units.position == kCounts && (bits == 0 || translation))
    throw ConfigError(
        fmt::format("gapscope: {} {}, expected --bits of a rotary encoder beside it, or the size of one "
                    "count as a number "
                    "(--position-unit)",
                    units.position.empty() ? shown(o.columns.position) + " is in" : "--position-unit is",
                    c.units.position));
  o.columns.scales = declared_scales(
      c.units, c.registers, gear, encoder(), coordinates(), [&](const std::string& key, auto& expected) {
        const std::string& unit = key == "time"      ? c.units.time
                                  : key == "input"   ? c.units.input
                                  : key == "voltage" ? c.units.voltage
                                  : key == "speed"   ? c.units.speed
                                                     : c.units.position;
        throw ConfigError(
            fmt::format("gapscope: --{}-unit {} is not known, expected {}", key, shown(unit), expected));
      });
  if (!window.empty()) o.window = {window[0], window[1]};
  if (o.window && !(o.window->first < o.window->second))
    throw ConfigError("gapscope: --window goes backwards, expected FROM before TO [s]");
  if (resample > 0.0) o.resample_rate = resample;
  return c;
}

std::vector<RecordingArguments> RecordingArguments::each_axis() const {
  if (!preset.empty()) {
    RecordingArguments declared = with_preset(*this);
    declared.preset.clear();
    return declared.each_axis();
  }
  if (axis.empty()) return {with_guesses(*this)};
  RecordingArguments pattern = *this;
  pattern.axis = kAllAxes;
  std::vector<RecordingArguments> all;
  for (const std::string& one : asked_axes(axis, file, pattern.configuration().reading.columns)) {
    all.push_back(*this);
    all.back().axis = one;
  }
  return all;
}

namespace {

void add_unit_options(CommandLine& command, RecordingArguments& a) {
  const auto unit = [&](const char* name, std::string& declared, const char* what) {
    command.add_option(name, declared, what).value("UNIT");
  };
  unit("--time-unit", a.units.time, "of the time: s, ms, us, ns, min (default: s)");
  unit("--input-unit", a.units.input, "of the input: N m, mN m, A, mA, V, %, ... (default: as it is)");
  unit("--position-unit", a.units.position,
       "of the position: rad, mrad, deg, arcmin, arcsec, rev, counts; m, mm, um, nm (default: rad, m)");
  unit("--speed-unit", a.units.speed,
       "of the speed: rad/s, deg/s, rpm, rev/s; m/s, mm/s, ... (default: rad/s, m/s)");
  unit("--voltage-unit", a.units.voltage, "of the supply's voltage: V, mV (default: V)");
  command
      .add_option("--input-register", a.input_register,
                  "how a signed number was held that was read as an unsigned one: bits of two's complement "
                  "(65535 is -1 of 16), sign10 (bit 10 above the size), offset2048")
      .value("FORM");
  command.add_option("--bits", a.bits, "of the encoder, for --position-unit counts").value("N").within(1, 40);
  command
      .add_option("--gear-ratio", a.gear.position,
                  "turns of the encoder per turn of the axis to be looked at")
      .value("RATIO")
      .accepts([](const std::string& text) {
        const double ratio = std::abs(decimal(text).value_or(0.0));
        return std::string(ratio >= 1e-6 && ratio <= 1e6 ? "" : "expected 1e-6 to 1e6, or as much below 0");
      });
}

void add_controller_options(CommandLine& command, RecordingArguments& a) {
  command
      .add_option("--target", a.target,
                  "column of the commanded position, of which the controller below makes the input")
      .value("NAME");
  command
      .add_option(
          "--controller-gain", a.gain,
          "input unit (with --voltage: duty) per rad of position error, or estimate: the fit finds it")
      .value("GAIN")
      .accepts([](const std::string& text) {
        return std::string(text == kSought || std::abs(decimal(text).value_or(kInfinity)) <= 1e12
                               ? ""
                               : "expected a number up to 1e12, or estimate");
      });
  command
      .add_option("--set", a.set,
                  "another number of that controller, as controller: has it, e.g. "
                  "controller.position.saturation=1; may be repeated")
      .value("controller.KEY=VALUE")
      .one_value_each();
}

}  // namespace

void add_recording_arguments(CommandLine& command, RecordingArguments& a) {
  command.add_option("FILE", a.file, "recording (CSV, .mat, .npz, HDF5, MCAP, .db3 or JSON)").required();
  command.heading_of_options("Columns and rows");
  command.add_option("--time", a.time, "column (or array) of the time (default: t, or as it is called)")
      .value("NAME");
  command.add_option("--input", a.input, "column of the input (default: u, or as it is called)")
      .value("NAME");
  command
      .add_option("--position", a.position,
                  "column of the position (default: x1, of the load x2, or as it is called)")
      .value("NAME");
  command
      .add_option("--speed", a.speed,
                  "column of the speed, of which x1 is the integral, in place of the position")
      .value("NAME");
  command
      .add_option("--columns", a.columns,
                  "all three at once, by name or place from 1 on; with --rate the last two")
      .value("TIME,INPUT,POSITION");
  command.add_option("--rate", a.rate, "of the rows, where the file has no time [Hz]")
      .value("RATE")
      .within(1e-3, 1e7);
  command
      .add_option("--input-rows", a.input_rows,
                  "rows that the input is moved by: -1 where a row has what acted before it")
      .value("ROWS")
      .within(-kMostInputRows, kMostInputRows);
  std::vector<std::string> presets;
  for (const DrivePreset& p : drive_presets()) presets.emplace_back(p.name);
  command
      .add_option("--preset", a.preset,
                  "columns and units as a common drive writes them; what is given beside it comes first")
      .value("DRIVE")
      .one_of(presets);
  command
      .add_option("--axis", a.axis,
                  "axis that stands for {axis} in the names of columns, or all (default names: "
                  "{axis}.position, {axis}.effort)")
      .value("NAME");
  command.add_option("--encoder-side", a.side, "body that the position is of: motor or load (default: motor)")
      .value("SIDE")
      .one_of({"motor", "load"});
  command
      .add_option("--voltage", a.voltage, "column of the supply's voltage: u is the input, a duty, times it")
      .value("NAME");
  command.add_option("--window", a.window, "part of each file that is used, held out or not [s]")
      .value("FROM TO")
      .values(2, 2)
      .within(-1e15, 1e15);
  command.add_option("--resample", a.resample, "rate that it is brought to [Hz]")
      .value("RATE")
      .within(1e-3, 1e7);
  command.heading_of_options("Units");
  command.add_flag("--translation", a.translation, "positions in m and forces in N instead of rad and N m");
  add_unit_options(command, a);
  command.heading_of_options("A servo that logs its goal");
  add_controller_options(command, a);
  command.heading_of_options("Beyond the recording");
}

void require_three_columns(const RecordingColumns& c) {
  const std::string& input = c.reads_input() ? c.input : c.target;
  const bool timed = c.rate == 0.0;
  if ((timed && (c.time == input || c.time == c.position)) || input == c.position)
    throw ConfigError(
        "gapscope: --time, --input and --position name one column twice, expected three columns");
}

std::string require_file_name(const std::string& file, const std::vector<std::string>& sources,
                              bool (*is_own)(const std::string& file)) {
  namespace fs = std::filesystem;
  const std::string found = content_identity(file);
  std::error_code problem;
  const fs::file_status there = fs::status(file, problem);
  if (problem && there.type() != fs::file_type::not_found)
    throw ConfigError(file, "cannot be written (" + problem.message() + "), expected another name");
  if (fs::is_directory(there)) throw ConfigError(file, "is a folder, expected the name of a file to write");
  const bool linked = fs::is_symlink(fs::symlink_status(file, problem)) && !file.starts_with("/dev/");
  if (linked && (fs::is_regular_file(there) || !fs::exists(there)))
    throw ConfigError(file, "is a link to another file, expected the name of the file itself");
  for (const std::string& source : sources)
    if (fs::equivalent(file, source, problem))
      throw ConfigError(file, "is the input itself, expected another file to write");
  const fs::path parent = fs::path(file).parent_path();
  if (!parent.empty() && !fs::is_directory(parent, problem))
    throw ConfigError(file, "cannot be written there, expected a folder that exists");
  if (fs::is_regular_file(there) && fs::file_size(file, problem) > 0 && !is_own(file))
    throw ConfigError(file,
                      "is there already, expected another name (-o FILE), or that it is deleted first: it is "
                      "not overwritten");
  return found;
}

}  // namespace gapscope::cli
