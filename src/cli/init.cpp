// `init`: a first configuration from a recording.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/input_facts.h"
#include "base/plain_name.h"
#include "base/shell_word.h"
#include "base/shown.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/presets.h"
#include "config/starter.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"

namespace gapscope::cli {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
  RecordingArguments recording;
  std::vector<std::string> further;  ///< recordings beside the first
  std::string held_out;              ///< a recording; empty: none
  std::string output;
  std::string model;                               ///< empty: as the detector sees it
  std::string from, joint;                         ///< of a simulator's model; empty: none
  std::string options;                             ///< all that were given but --held-out and --output
  double mass = kNaN, arm = kNaN, inertia = kNaN;  ///< known of the drive [kg, m, kg m² or kg]
  double torque_constant = kNaN;                   ///< of the motor [N m or N per unit of u]
};

StarterModel model_of(const std::string& word) {
  if (word == "gap") return StarterModel::kGap;
  if (word == "locked") return StarterModel::kLocked;
  return word.empty() ? StarterModel::kAsSeen : StarterModel::kOneBody;
}

std::optional<JointNumbers> nominal_of(const InitArguments& a) {
  if (a.from.empty()) return {};
  JointNumbers numbers = joint_numbers(a.from, a.joint);
  if (numbers.slides == a.recording.coordinates().rotational())
    throw ConfigError(a.from, fmt::format("says that joint '{}' {}, expected {}", printable(a.joint, 40),
                                          numbers.slides ? "slides" : "turns",
                                          numbers.slides ? "--translation" : "no --translation"));
  return numbers;
}

/// What fixes the scale of the torques; nothing: none is known
std::optional<AnchorConfig> anchor_of(const InitArguments& a) {
  AnchorConfig anchor;
  anchor.mass = a.mass, anchor.arm = a.arm, anchor.inertia = a.inertia;
  if (a.torque_constant > 0.0 || (std::isnan(a.mass) && std::isnan(a.inertia))) return {};
  return anchor;
}

/// A number that is told in another unit than asked for, where it is larger than that of any drive at hand.
struct UnitSlip {
  const char* option;
  double value, most;  ///< [unit]
  const char *unit, *smaller;
  double per_unit;  ///< one of the smaller ones [unit]
};

/// Questions, not errors: "--arm: 105 m? 105 mm is 0.105".
std::vector<std::string> asked_of_units(const InitArguments& a) {
  const bool turns = a.recording.coordinates().rotational();
  // No joint with one encoder turns more; a slip is a hundred times and more. An arm of 10 cm is seldom
  // written as 30 or more, one in mm is.
  const UnitSlip slips[] = {
      {"--arm", a.arm, 3.0, "m", a.arm < 30.0 ? "cm" : "mm", a.arm < 30.0 ? 1e-2 : 1e-3},
      {"--mass", a.mass, 200.0, "kg", "g", 1e-3},
      turns ? UnitSlip{"--inertia", a.inertia, 100.0, "kg m^2", "kg cm^2", 1e-4}
            : UnitSlip{"--inertia", a.inertia, 1e4, "kg", "g", 1e-3}};
  std::vector<std::string> questions;
  for (const UnitSlip& s : slips)
    if (s.value > s.most)
      questions.push_back(fmt::format("{}: {:g} {}? {:g} {} is {:g}", s.option, s.value, s.unit, s.value,
                                      s.smaller, s.value * s.per_unit));
  return questions;
}

/// The recordings that are fitted.
std::vector<std::string> fitted_files(const InitArguments& a) {
  std::vector<std::string> files{a.recording.file};
  files.insert(files.end(), a.further.begin(), a.further.end());
  return files;
}

/// @throws ConfigError where the one that is held out is fitted, or one is named twice
void require_other_recordings(const InitArguments& a) {
  std::error_code problem;
  const std::vector<std::string> files = fitted_files(a);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!a.held_out.empty() && fs::equivalent(a.held_out, files[i], problem))
      throw ConfigError(fmt::format("gapscope: --held-out is {}, {}, expected another one",
                                    printable(a.held_out, 200),
                                    files.size() == 1 ? "the recording itself" : "one of the recordings"));
    for (std::size_t k = 0; k < i; ++k)
      if (fs::equivalent(files[k], files[i], problem))
        throw ConfigError(fmt::format("gapscope: {} is named twice, expected recordings that differ",
                                      printable(files[i], 200)));
  }
}

/// Both recordings, as if a configuration had named them.
RecordingConfig recordings_of(const InitArguments& a, const RecordingArguments& r) {
  RecordingConfig config = r.configuration();
  for (const std::string& file : a.further) config.files.push_back({.given = file, .path = file});
  if (!a.held_out.empty()) config.held_out.push_back({.given = a.held_out, .path = a.held_out});
  return config;
}

/// Several axes each have a configuration of their own, called after them.
std::string output_of(const InitArguments& a, const RecordingArguments& r, bool several) {
  const std::string one = a.output.empty() ? fs::path(r.file).stem().string() + ".yaml" : a.output;
  if (!several) return one;
  const std::string name = fs::path(one).stem().string() + "_" + plain_part(r.axis) + ".yaml";
  return (fs::path(one).parent_path() / name).string();
}

/// For the command with both recordings the other way round: the same, into another file than is written.
std::string options_turned_round(const InitArguments& a, const RecordingArguments& r) {
  const fs::path one = output_of(a, r, false);
  if (a.output.empty() && fs::path(a.held_out).stem() != one.stem()) return a.options;
  const std::string other = (one.parent_path() / (one.stem().string() + "_turned_round.yaml")).string();
  return a.options + (a.options.empty() ? "" : " ") + "-o " + shell_word(other);
}

/// What brings a diagnosis back into the MJCF that it began with; empty: it began with none.
std::string way_back(const InitArguments& a, const StarterKnowledge& known, const std::string& name) {
  if (!known.nominal || !known.nominal->of_mjcf) return "";
  const std::string report = shell_word("reports/" + name), into = shell_word(name + "_mjcf");
  return fmt::format("{:<12}after diagnose: gapscope export {} --to mjcf -o {} --into {} --joint {}\n",
                     "back", report, into, shell_word(a.from), shell_word(a.joint));
}

/// The name of an axis at the end of that which its report will have.
std::string named_after(const std::string& axis, std::string yaml) {
  const auto end = yaml.find_first_of(" \n", yaml.find("\nname: ") + 7);
  return yaml.insert(end, "_" + plain_part(axis));
}

/// The recording under the servo of the simulator's model, where nothing else is given.
RecordingArguments under_servo(RecordingArguments r, const std::optional<JointNumbers>& nominal) {
  if (nominal && nominal->servo && r.gain.empty() && !r.target.empty()) r.of_model = nominal->servo;
  return r;
}

void write_starter(const InitArguments& a, const RecordingArguments& recording, bool several) {
  const std::string name = fs::path(a.output).stem().string();  // a name that was given is the report's, too
  const std::optional<JointNumbers> nominal = nominal_of(a);
  const RecordingArguments r = under_servo(recording, nominal);
  const StarterKnowledge known{model_of(a.model),
                               nominal,
                               anchor_of(a),
                               a.torque_constant,
                               a.torque_constant > 0.0 ? a.inertia : kNaN,
                               name,
                               options_turned_round(a, r),
                               r.gain_sought()};
  const std::string output = output_of(a, r, several);
  std::vector<std::string> inputs = fitted_files(a);
  inputs.push_back(a.held_out);
  require_file_name(output, inputs, [](const std::string&) { return false; });
  const fs::path parent = fs::path(output).parent_path();
  const Starter starter = starter_configuration(recordings_of(a, r), r.encoder(), r.coordinates(),
                                                parent.empty() ? "." : parent.string(), known);
  const Configuration read =
      parse_configuration(starter.yaml, output);  // throws where an anchor does not suit
  write_text(output, several ? named_after(r.axis, starter.yaml) : starter.yaml, "");
  print_warnings(starter.remarks);
  print_warnings(starter.spoiling);
  fmt::print("{:<12}{}\n", "written", output);
  if (const std::string told = r.told_by_names(); !told.empty()) fmt::print("{:<12}{}\n", "units", told);
  tell_assumed(starter.assumed, r.coordinates());
  fmt::print("{:<12}{}\n", "model", starter.model);
  if (known.anchor) fmt::print("{:<12}{}\n", "anchor", known.anchor->told(r.coordinates()));
  if (!starter.hangs.empty()) fmt::print("{:<12}{}\n", "hangs_at", starter.hangs);
  if (!starter.order.empty())
    fmt::print("{:<12}{}\n", "order", with_input_unit(starter.order, read.input_facts()));
  if (!r.window.empty() && !a.held_out.empty())
    fmt::print("{:<12}{:g} to {:g} s of both files, also of {}, which is held out\n", "window", r.window[0],
               r.window[1], printable(a.held_out, 200));
  fmt::print("{:<12}{}gapscope {} {} (or {})\n", "next",
             starter.guesses ? "fill in what is marked GUESS, then " : "",
             a.held_out.empty() ? "run" : "diagnose", shell_word(output),
             a.held_out.empty() ? "detect, fit, diagnose" : "run, detect, fit");
  fmt::print("{}", way_back(a, known, read.name));
}

}  // namespace

void add_init(CommandLine& app) {
  auto arguments = std::make_shared<InitArguments>();
  CommandLine command = app.add_command("init", "A first configuration from a recording");
  add_recording_arguments(command, arguments->recording);
  command.add_option("MORE", arguments->further, "further recordings of the drive, read and fitted alike")
      .values(0);
  command
      .add_option("--held-out", arguments->held_out,
                  "a second recording of this drive, which diagnose judges by (default: the last third); the "
                  "richer one (speed, travel, input, reversals) is better fitted: init says which it is")
      .value("FILE");
  command
      .add_option("-o,--output", arguments->output,
                  "configuration to write; its name is the report's (default: the recording's name, here; "
                  "the report of --from is called after the joint)")
      .value("CONFIG");
  command
      .add_option("--model", arguments->model,
                  "gap, locked (the output does not move) or one_body (default: what the detector sees)")
      .value("KIND")
      .one_of({"gap", "locked", "one_body"});
  Option from = command.add_option("--from", arguments->from, "MJCF or URDF with the numbers to begin with")
                    .value("MODEL");
  Option joint =
      command.add_option("--joint", arguments->joint, "joint in it that is the drive").value("NAME");
  from.needs(joint);
  joint.needs(from);
  Option mass =
      command.add_option("--mass", arguments->mass, "known mass on an arm that turns with the position [kg]")
          .value("MASS")
          .within(1e-9, 1e9);
  Option arm = command.add_option("--arm", arguments->arm, "its distance from the axis [m]")
                   .value("LENGTH")
                   .within(1e-9, 1e6);
  mass.needs(arm);
  arm.needs(mass);
  Option inertia = command
                       .add_option("--inertia", arguments->inertia,
                                   "motor inertia; with --torque-constant, the rotor inertia from the data "
                                   "sheet (before the gear) [kg m^2; of a slide kg]")
                       .value("INERTIA")
                       .within(1e-12, 1e9);
  for (Option* anchor : {&mass, &inertia}) anchor->excludes(from);
  inertia.excludes(mass);
  Option constant = command
                        .add_option("--torque-constant", arguments->torque_constant,
                                    "the sheet's, of the motor, before a gear [N m per unit of the input, "
                                    "for a current per A; of a slide N]")
                        .value("CONSTANT")
                        .within(1e-9, 1e9);
  for (Option* other : {&from, &mass}) constant.excludes(*other);
  command.footer(
      "Reads off the recordings what they show: columns, a rate for the detector where time is not uniform,\n"
      "the step of the encoder [rad], and whether the model needs a gap, a locked output or one body (the\n"
      "detector decides). Of one body inertia, damping and Coulomb friction are read, for the fit to begin\n"
      "with: diagnose then says what is missing beside them.\n"
      "What they do not show is marked GUESS (torque_constant [N m per unit of u]: 1, unless it is given or\n"
      "--input-unit is one of torque or force) or left to the fit.\n"
      "--torque-constant and --inertia together are the motor's sheet, and fixed; of one body its inertia is\n"
      "where the fit begins, as it is that of all that moves.\n"
      "--mass with --arm, or --inertia, is what sets the scale where nobody knows torque_constant: it is then\n"
      "written as anchor:, and the fit finds torque_constant; where an arm hangs down (anchor: hangs_at) is read\n"
      "off the recording or taken as position 0.\n"
      "A gap that the detector does not see (inconclusive) is a GUESS too.\n"
      "--preset dynamixel, feetech, odrive, moteus or twincat declares the columns and units that these drives write.\n"
      "--from reads armature, damping, frictionloss, gear and the body's inertia of a joint, of MJCF with its\n"
      "classes, geoms, gravity and the actuator's filter, range and constant bias; a gap where a fixed tendon\n"
      "limits the difference of two joints or a second joint of the body has a narrow range. The fit begins\n"
      "there, and diagnose says what that model lacks.\n"
      "run, fit, detect and diagnose accept the configuration as it is. Nothing is overwritten.\n\n"
      "Example: gapscope init drive.csv --input i_q --position theta -o drive.yaml");
  command.action([arguments, command] {
    require_other_recordings(*arguments);
    arguments->options = command.given_options({"--held-out", "--output"});
    const auto all = arguments->recording.each_axis();
    if (const std::string banner = preset_banner(arguments->recording); !banner.empty())
      fmt::print("{:<12}{}\n", "preset", banner);
    print_warnings(preset_remarks(arguments->recording));
    print_warnings(asked_of_units(*arguments));
    for (const RecordingArguments& one : all) write_starter(*arguments, one, all.size() > 1);
  });
}

}  // namespace gapscope::cli
