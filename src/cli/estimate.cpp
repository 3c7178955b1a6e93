// `run`, `detect` and `fit`: the same pipeline with both estimators, or one of them.
#include "commands/estimate.h"

#include <fmt/format.h>

#include <memory>

#include "base/interrupt.h"
#include "base/plain_name.h"
#include "base/shell_word.h"
#include "base/shown.h"
#include "changes/changes.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/detect_stream.h"
#include "cli/field_help.h"
#include "commands/axis.h"
#include "commands/drive_folder.h"
#include "gapscope/base/errors.h"
#include "report/changes_report.h"

namespace gapscope::cli {
namespace {

struct EstimateArguments {
  ConfigArguments config;
  std::string folder;
  std::string axis;  ///< of a machine with several: one of them, or all
  bool quiet = false;
  FigureFormats figures;
  bool stream = false;  ///< the rest is for `detect --stream` alone
  RecordingColumns columns;
  double quantum = 0.0;   ///< [rad]; 0: as the samples show
  double resample = 0.0;  ///< [Hz]; 0: as it stands
};

void estimate(const EstimateArguments& a, const Configuration& c, const std::string& folder,
              const Estimators& wanted, const std::string& axis = "") {
  ReportFolder report = drive_folder(folder, c);
  const Progress progress = progress_on_terminal(a.quiet);
  RunOutcome outcome = make_estimate(c, wanted, progress);
  const FinishFirst first;  // from here on a Ctrl-C takes nothing away that was estimated
  if (outcome.stopped) request_finish();
  progress("drawing the report");
  write_estimate(report, c, a.figures, outcome);
  print_warnings(outcome.warnings);
  ToldConfiguration told = a.config.told(a.folder, axis);
  if (!c.model.given) told.to_begin = c.recording ? shell_word(c.recording->files.front().path) : "RECORDING";
  print_headline(folder, outcome.result, told);
  if (finish_requested() || stop_requested()) throw ExitStatus{kInterruptedWithReport};
}

std::string folder_of(const EstimateArguments& a, const Configuration& c) {
  return a.folder.empty() ? "reports/" + c.name : a.folder;
}

/// A report for each axis and one table of all.
void estimate_axes(const EstimateArguments& a, const Configuration& c, const Estimators& wanted) {
  if (a.axis.empty()) return estimate(a, c, folder_of(a, c), wanted);
  if (!c.recording)
    throw ConfigError(c.file, "has no recording: beside --axis, expected one with several axes");
  std::vector<DriveReport> reports;
  const std::vector<std::string> axes =
      asked_axes(a.axis, c.recording->files.front().path, c.recording->reading.columns);
  for (const std::string& axis : axes) {
    const std::string folder = folder_of(a, c) + "/" + plain_part(axis);
    if (axes.size() > 1) say("axis", printable(axis, 60));
    estimate(a, of_axis(c, axis), folder, wanted, axis);
    reports.push_back(read_drive_report(folder));
  }
  if (reports.size() > 1) fmt::print("\n{}", spread_text(changes(reports)));
}

CommandLine add(CommandLine& app, const char* name, const char* what, const std::string& details,
                Estimators wanted,
                const std::shared_ptr<EstimateArguments>& arguments = std::make_shared<EstimateArguments>()) {
  CommandLine command = app.add_command(name, what);
  add_config_arguments(command, arguments->config);
  command.add_option("-o,--output", arguments->folder, kReportFolderHelp).value("DIR");
  command
      .add_option("--axis", arguments->axis,
                  "axis that stands for {axis} in recording: columns, or all: a report for each in "
                  "DIR/<axis>, and a table")
      .value("NAME");
  command.add_flag("--svg", arguments->figures.svg, kSvgHelp);
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer(details);
  command.action([arguments, wanted] {
    with_configuration(arguments->config,
                       [&](const Configuration& c) { estimate_axes(*arguments, c, wanted); });
  });
  return command;
}

/// `--stream` takes the place of a configuration.
void add_streaming(CommandLine& detect, const std::shared_ptr<EstimateArguments>& a) {
  Option config = detect.option("CONFIG").required(false);
  Option stream = detect.add_flag("--stream", a->stream, "a CSV from standard input, an event a line");
  stream.excludes(config)
      .excludes(detect.option("--output"))
      .excludes(detect.option("--set"))
      .excludes(detect.option("--model-from"))
      .excludes(detect.option("--axis"))
      .excludes(detect.option("--svg"));
  const auto column = [&](const char* name, std::string& place, const char* what) {
    detect.add_option(name, place, what).value("NAME").needs(stream);
  };
  column("--time", a->columns.time, "of a stream: column of the time [s] (default: t)");
  column("--input", a->columns.input, "of a stream: column of the input (default: u)");
  column("--position", a->columns.position, "of a stream: column of the position (default: x1)");
  detect
      .add_option("--quantum", a->quantum,
                  "of a stream: step of the encoder [rad; m where x1 is] (default: as it shows)")
      .value("RAD")
      .within(1e-15, 1e3)
      .needs(stream);
  detect
      .add_option("--resample", a->resample,
                  "of a stream whose time is not uniform: rate that it is brought to [Hz]")
      .value("RATE")
      .within(1e-3, 1e7)
      .needs(stream);
  detect.action([a, config] {
    if (a->stream) {
      require_three_columns(a->columns);
      return detect_stream(a->columns, a->quantum, a->resample);
    }
    if (!config.given()) throw_missing("CONFIG");
    with_configuration(a->config,
                       [&](const Configuration& c) { estimate_axes(*a, c, {.reference = false}); });
  });
}

std::string fit_details() {
  std::string text =
      "Writes the same files as run, with \"model_free\": null.\n\n"
      "Parameters (model: parameters), each a number or {value, estimate, bounds, prior: {value, std}}; gap,\n"
      "motor_damping and mass_ratio are estimated when their key is absent:\n";
  for (const DriveParameterSpec& spec : kDriveParameters)
    text += fmt::format("    {:<42}{}\n", fmt::format("{} [{}]", spec.key, spec.unit), spec.doc);
  return text + "\nHow it is found (fit:, optional):\n" + field_help(FitOptions{}, "    ") +
         "\nExample: gapscope fit configs/02_experiment.yaml -o reports/fitted";
}

}  // namespace

void add_run(CommandLine& app) {
  add(app, "run", "Both estimators, their comparison, and a report with figures",
      "Writes DIR/result.json, report.md and report.html, figures (PNG), traces/, resolved.yaml, timing.json "
      "and files.json,\n"
      "which lists them: only what it lists is replaced by the next report, any other folder is refused.\n"
      "On standard output gaps are in mrad (mm for coordinates: translation), in result.json in rad (m).\n"
      "What `gapscope check` says will spoil the estimates is a warning; where it doubts the unit of x1 no\n"
      "trust is good.\n"
      "Ctrl-C while the model is still fitted keeps the reading without a model, and while the report is\n"
      "drawn all of it (exit status 130); a second one ends at once and keeps nothing.\n\n"
      "Example: gapscope run configs/02_experiment.yaml -o reports/experiment",
      {.reading_is_kept = true});
}

void add_detect(CommandLine& app) {
  const auto arguments = std::make_shared<EstimateArguments>();
  CommandLine command = add(
      app, "detect", "The model-free detector alone: the gap from the motor encoder, without a model",
      "Writes the same files as run, with \"reference\": null. How it looks is detector: method:\n"
      "  auto         impacts, and where they show no gap the lost-motion loop (slow ramps, locked output)\n"
      "  impact       impacts alone\n"
      "  lost_motion  the loop alone: x1 at zero torque after ramps to either side\n"
      "  literal      S1 to S6 of the paper as printed, with the bound L that is given: no interval\n"
      "  paper        the same, improved, with an interval\n"
      "L is detector: bound [rad/s^2]: auto, a number, or {from_model: {input_limit [unit of u, the paper's U_max],\n"
      "load_force_bound [N m, the paper's G]}}; with one of the latter auto means paper. With model: load: "
      "locked no reason speaks of a load that\n"
      "could rest. The lost motion is given wherever there is a loop, whatever the verdict.\n\n"
      "--stream reads a CSV (t, u, x1) from standard input and writes lines of JSON (units in the keys):\n"
      "  settings first: the version, the columns as they are read and the SHA-256 of that text\n"
      "  learnt   once: bounds, floors and thresholds, from the first two periods and frozen from then on\n"
      "  event    each passage of the gap, at most 3/4 of a half period after its impact: t1, t2, direction,\n"
      "           gap, standard error; accepted, or the remark why not\n"
      "  summary  last, also on Ctrl-C and before a broken line is refused: verdict and gap of all passages\n"
      "           (of the last 8192), as in result.json\n"
      "A stream has no axis: rad, in its keys and reasons, is the unit of x1, m where x1 is in m. It counts\n"
      "half periods from turn to turn of the motion; detect on a whole recording counts from one passing of its\n"
      "middle to the next, which is one more where the recording begins at an end of the travel.\n"
      "Time that is not uniform needs --resample RATE, as resample: does in a configuration.\n"
      "Memory does not grow. Against a detector that sees all of it first, a stream cannot take back what the\n"
      "first two periods taught it (start it in steady motion; after another amplitude or frequency start it\n"
      "anew), and looks neither at all passages together (light loads, coarse encoders) nor at the\n"
      "lost-motion loop (locked outputs).\n\n"
      "Example: gapscope detect configs/02_experiment.yaml -o reports/detected\n"
      "         tail -n +1 -f drive.csv | gapscope detect --stream --input i_q > events.jsonl",
      {.reference = false}, arguments);
  add_streaming(command, arguments);
}

void add_fit(CommandLine& app) {
  add(app, "fit", "The fit of a model alone: parameters of the drive, fitted to u and x1", fit_details(),
      {.model_free = false, .literal = false});
}

}  // namespace gapscope::cli
