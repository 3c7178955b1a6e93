// `diagnose`: what the simulation of a drive lacks, from recordings of it.
#include "commands/diagnose.h"

#include <fmt/format.h>

#include <memory>

#include "base/interrupt.h"
#include "base/plain_name.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "commands/axis.h"
#include "commands/drive_folder.h"
#include "commands/leave_one_out.h"

namespace gapscope::cli {
namespace {

struct DiagnoseArguments {
  ConfigArguments config;
  std::string folder;
  std::string axis;  ///< of a machine with several; empty: the configuration has one
  std::vector<std::string> excluded;
  std::vector<std::string> simulated;
  std::string left_out;  ///< what one after the other is left out; empty: nothing is
  int threads = 0;
  bool quiet = false;
  FigureFormats figures;
};

/// Those that were not told before the work began.
std::vector<std::string> without(std::vector<std::string> warnings, const std::vector<std::string>& told) {
  std::erase_if(warnings, [&](const std::string& w) { return contains(told, w); });
  return warnings;
}

/// Each group held out once, by the model that is fitted to all others; then the one that is fitted to all.
std::vector<LeftOutAnswer> leave_one_out(const DiagnoseArguments& a, Configuration& c,
                                         const DiagnosisOptions& options) {
  std::vector<LeftOutAnswer> answers;
  if (a.left_out.empty()) return answers;
  const std::vector<LeftOut> groups = groups_to_leave_out(c, a.left_out);
  for (const LeftOut& group : groups) {
    DiagnosisOptions one = options;
    const std::string which =
        fmt::format("{} of {}, without {}: ", answers.size() + 1, groups.size(), group.told);
    one.progress = [&](const std::string& step) { options.progress(which + step); };
    answers.push_back(left_out_answer(group, run_diagnosis(leaving_out(c, group), one)));
    if (finish_requested()) return answers;
  }
  c = of_all_recordings(std::move(c));
  return answers;
}

void diagnose_configuration(const DiagnoseArguments& a, Configuration& c) {
  if (!a.axis.empty()) c = of_axis(std::move(c), a.axis);
  exclude_effects(a.excluded, c);
  take_simulated(a.simulated, c);
  require_reference_model(c);
  const std::string folder =
      (a.folder.empty() ? "reports/" + c.name : a.folder) + (a.axis.empty() ? "" : "/" + plain_part(a.axis));
  ReportFolder report = drive_folder(folder, c);
  DiagnosisOptions options = diagnosis_options(c);
  options.threads = a.threads;
  options.progress = progress_on_terminal(a.quiet);
  std::vector<std::string> told;
  const auto tell = [&](const std::string& warning) {
    print_warnings({warning});
    told.push_back(warning);
  };
  const FinishFirst first;  // a first Ctrl-C leaves a report of what was found, also where it is being drawn
  const std::vector<LeftOutAnswer> left_out = leave_one_out(a, c, options);
  DiagnosisOutcome outcome = run_diagnosis(c, options, tell);
  DiagnosisResult& result = outcome.result;
  options.progress("drawing the report");
  std::vector<TextFile> more;
  if (!left_out.empty()) more.push_back({"leave_one_out.csv", csv_of(left_out)});
  write_diagnosis(report, c, a.figures, outcome, more);
  print_warnings(without(result.diagnosis.warnings, told));
  if (result.simulated) print_warnings(result.simulated->warnings);
  if (!left_out.empty()) {
    fmt::print("{}", left_out_table(left_out));
    say("recommended", recommended(left_out));
  }
  print_diagnosis(folder, result, a.config.told(a.folder, a.axis));
  if (finish_requested()) throw ExitStatus{kInterruptedWithReport};
}

}  // namespace

void add_diagnose(CommandLine& app) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CommandLine command =
      app.add_command("diagnose", "Why the simulated drive does not move like the real one");
  add_config_arguments(command, arguments->config);
  command.add_option("-o,--output", arguments->folder, kReportFolderHelp).value("DIR");
  command
      .add_option("--axis", arguments->axis,
                  "axis that stands for {axis} in recording: columns; the report is in DIR/<axis>")
      .value("NAME");
  command.add_option("--exclude", arguments->excluded, "an effect that is no candidate; may be repeated")
      .value("EFFECT")
      .one_value_each();
  command
      .add_option("--simulated", arguments->simulated,
                  "CSV with what your simulator answers to the recorded input; one for each recording")
      .value("SIM.csv")
      .one_value_each();
  command
      .add_option("--leave-one-out", arguments->left_out,
                  "recording, mass, arm, gain or voltage: all recordings, or all with one value, are held "
                  "out in turn; DIR then has the model fitted to all and leave_one_out.csv")
      .value("KEY");
  command.add_flag("--svg", arguments->figures.svg, kSvgHelp);
  add_work_options(command, arguments->threads, arguments->quiet);
  command.footer(
      "Fits the model to recording: file, adds the effects of `gapscope effects` in turn, and judges on\n"
      "recording: held_out (a file or a list; without it on the last third of each file). recording: window\n"
      "[s] cuts each of these files, those held out as well. Left out are\n"
      "those that the model has already or has no place for (of a load, gap or contact where it is one\n"
      "body), what would turn with a shaft that does not turn, coarser counts where the recording has\n"
      "none, what --exclude names, and, where the torque balance of one body decides, laws that it shows\n"
      "not to help. What `gapscope check`\n"
      "says will spoil the estimates is a warning, of each of these files alike.\n"
      "Writes DIR/diagnosis.json [rad, N m, s], fitted.yaml, report.md and report.html, figures (PNG),\n"
      "traces/held_out_*.\n"
      "What no effect explains is tried as any function of speed, position or input: a law of last resort\n"
      "takes DIR/compensation_<law>.csv, the table for the drive's feed-forward, and fitted_with_law.yaml.\n"
      "Where two explanations come close and the drive takes u (no goals), next_experiment.yaml\n"
      "and .csv hold the input that separates them best, of those tried within next_experiment: {input: ...,\n"
      "travel: ..., lowest_frequency: ..., highest_frequency: ..., duration: ...}; the report says whether that\n"
      "is enough. Where none comes close to another, neither file is made.\n"
      "diagnosis: {periods_per_turn: [4], periods: [2.5e-3], outside_catalogue: 0.5} states pole pairs or\n"
      "teeth, of a screw's pitch [rad; m with coordinates: translation], and how likely the catalogue lacks what\n"
      "is missing; exclude: [load_unbalance] is what --exclude says. detectable: true gives the smallest "
      "amount of each\n"
      "effect that would have been named on these recordings; after none and unknown it is always given.\n"
      "--simulated lays your simulator (MuJoCo, Isaac, Drake, Gazebo, C code) beside the drive: run it under the\n"
      "recorded u, from where the drive began, write t, u, x1 (columns and units as in the recording; u may be left\n"
      "out, a finer step does no harm), and give one file for each file: of the configuration, then for each held_out.\n"
      "The same model is fitted to both; the report has a table of what is in the drive, in the simulator or in both\n"
      "with other amounts, and how far the error shrinks if the first line is mended. In the configuration:\n"
      "recording: {file: drive.csv, simulated: sim.csv}.\n"
      "Ctrl-C ends the search after its present step: the report says that it was stopped and what it had found by\n"
      "then (exit status 130). A second one ends the command at once, and nothing is kept.\n"
      "The verdict is effect (the cause of the first addition is established; only likely where the torque\n"
      "balance alone shows it, which the card then says), helps (something takes much\n"
      "of the error, whether it is the cause is open), none (the model is at the floor: that of the encoder or, where\n"
      "the drive repeats its motion far worse, that of its repeatability; its numbers may still be others\n"
      "than the configuration's) or unknown (nothing in the catalogue explains it).\n\n"
      "Example: gapscope diagnose drive.yaml -o reports/drive --exclude load_unbalance\n"
      "Example: gapscope diagnose drive.yaml -o reports/drive --simulated mujoco.csv");
  command.action([arguments] {
    with_configuration(arguments->config, [&](Configuration& c) { diagnose_configuration(*arguments, c); });
  });
}

}  // namespace gapscope::cli
