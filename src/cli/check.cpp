// `check`: what a recording is worth before anything is estimated from it.
#include "commands/check.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/input_facts.h"
#include "base/shown.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/presets.h"
#include "gapscope/base/errors.h"
#include "inspection/reach.h"
#include "report/recording_picture.h"
#include "results/inspection_result.h"

namespace gapscope::cli {
namespace {

struct CheckArguments {
  RecordingArguments recording;
  std::vector<std::string> further;  ///< recordings, read alike
  std::string output;
  std::string picture;  ///< PNG to draw; empty: none
  std::string purpose;  ///< gap, fit or diagnosis; empty: all
  bool json = false;
};

/// As a configuration beside the recording would have it: the same in every folder.
Configuration reading_of(const RecordingArguments& r) {
  Configuration c;
  c.recording = r.configuration();
  c.recording->files.front().given = std::filesystem::path(r.file).filename().string();
  c.encoder = r.encoder();
  c.coordinates = r.coordinates();
  return c;
}

Purpose purpose_of(const std::string& word) {
  return word == "gap"   ? Purpose::kGap
         : word == "fit" ? Purpose::kFit
         : word.empty()  ? Purpose::kAll
                         : Purpose::kDiagnosis;
}

/// The content that a picture of that name stands for; refused where it would overwrite something.
std::string require_picture_name(const CheckArguments& a, const RecordingArguments& r) {
  return require_file_name(a.picture, {r.file}, [](const std::string&) { return false; });
}

/// What was seen, with what is not fine below the title.
void draw(const CheckArguments& a, const Inspection& inspection, const RecordingArguments& r,
          const RecordingConfig& recording) {
  std::vector<std::string> lines;
  for (const Finding& f : inspection.findings)
    if (f.severity == Severity::kSpoils) lines.push_back(f.rule + ": " + f.found);
  if (lines.empty()) lines.emplace_back("nothing spoils the estimates");
  const std::string found = require_picture_name(a, r);
  write_text(a.picture,
             recording_picture(read_recording(r.file, recording.reading_for(UnevenRows::kStamped)),
                               inspection.coordinates, reading_of(r).input_facts(), lines),
             found);
}

Inspection check_recording(const CheckArguments& a, const RecordingArguments& r) {
  const auto look = [&] { return require_file_name(a.output, {r.file}, is_inspection_file); };
  if (!a.output.empty()) look();  // before the work
  if (!a.picture.empty()) require_picture_name(a, r);
  const Configuration c = reading_of(r);
  auto [inspection, json] = checked_recording(c, purpose_of(a.purpose));
  if (!a.output.empty()) write_text(a.output, json, look());
  if (const std::string told = r.told_by_names(); !a.json && !told.empty())
    fmt::print("{:<12}{}\n", "units", told);
  if (!a.json) tell_assumed(inspection.assumed, inspection.coordinates);
  fmt::print("{}", a.json ? json : inspection.report());
  std::fflush(stdout);  // read while the picture is drawn
  if (!a.picture.empty()) draw(a, inspection, r, *c.recording);
  return inspection;
}

/// Each recording, and of each the axes that are asked for.
std::vector<RecordingArguments> asked(const CheckArguments& a) {
  std::vector<RecordingArguments> all = a.recording.each_axis();
  for (const std::string& file : a.further) {
    RecordingArguments one = a.recording;
    one.file = file;
    for (RecordingArguments& axis : one.each_axis()) all.push_back(std::move(axis));
  }
  return all;
}

/// Whether two recordings ask the drive the same.
bool alike(const RecordingFacts& a, const RecordingFacts& b) {
  constexpr double kNear = 0.1;
  const auto near = [](double x, double y) {
    return std::abs(x - y) <= kNear * std::max(std::abs(x), std::abs(y));
  };
  return near(a.input_peak, b.input_peak) && near(a.input_frequency, b.input_frequency) &&
         near(a.travel, b.travel);
}

void tell_together(const std::vector<Inspection>& seen) {
  for (std::size_t i = 1; i < seen.size(); ++i)
    if (!alike(seen[0].facts, seen[i].facts)) return;
  if (seen.size() > 1)
    fmt::print(
        "\n{:<12}all {} recordings ask the drive the same (peak and frequency of u, travel)\n{:<12}-> record "
        "one with another waveform or amplitude, to be held out: it separates more causes\n",
        "together", seen.size(), "");
}

MotionReach reach_of(const RecordingArguments& r) {
  const Recording recording =
      read_recording(r.file, reading_of(r).recording->reading_for(UnevenRows::kStamped));
  const MotorTrace trace = recording.motor_trace();
  return gapscope::reach_of({&trace, 1});
}

/// Which of two recordings is to be fitted.
void tell_order(const std::vector<RecordingArguments>& all) {
  if (all.size() != 2) return;
  const FittingOrder order = fitting_order(reach_of(all[0]), reach_of(all[1]), all[0].coordinates());
  const std::string why = with_input_unit(order.why, reading_of(all[0]).input_facts());
  if (order.fit == FittingOrder::Fit::kEither) {
    fmt::print("\n{:<12}either may be fitted: {}\n", "order", why);
    return;
  }
  const bool first = order.fit == FittingOrder::Fit::kFirst;
  const std::string fitted = printable(all[first ? 0 : 1].file, 200);
  fmt::print(
      "\n{0:<12}{1} asks more of the drive ({2})\n{3:<12}-> fit it and hold the other one out: recording: "
      "{{file: {1}, held_out: {4}}}\n",
      "order", fitted, why, "", printable(all[first ? 1 : 0].file, 200));
}

void check_all(const CheckArguments& a) {
  const std::vector<RecordingArguments> all = asked(a);
  print_warnings(preset_remarks(a.recording));
  if (all.size() > 1 && (a.json || !a.output.empty() || !a.picture.empty()))
    throw ConfigError(
        fmt::format("gapscope: --json, --picture and --output are of one report, expected one file and one "
                    "axis beside them instead of {}",
                    all.size()));
  bool spoilt = false;
  std::vector<Inspection> seen;
  for (const RecordingArguments& one : all) {
    if (!seen.empty()) fmt::print("\n");
    if (!one.axis.empty() && all.size() > 1) fmt::print("{:<12}{}\n", "axis", printable(one.axis, 60));
    seen.push_back(check_recording(a, one));
    spoilt |= seen.back().spoilt();
  }
  if (purpose_of(a.purpose) == Purpose::kDiagnosis && a.recording.axis.empty()) {
    tell_together(seen);
    if (!spoilt) tell_order(all);
  }
  if (spoilt) throw ExitStatus{kSpoiltRecording};
}

}  // namespace

void add_check(CommandLine& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CommandLine command = app.add_command("check", "What a recording is worth: look before you estimate");
  add_recording_arguments(command, arguments->recording);
  command.add_option("MORE", arguments->further, "further recordings of the drive, read alike").values(0);
  command
      .add_option("--for", arguments->purpose,
                  "question that it is judged for: gap, fit or diagnosis (default: all of them)")
      .value("QUESTION")
      .one_of({"gap", "fit", "diagnosis"});
  command.add_option("-o,--output", arguments->output, "file to write the findings into (JSON)")
      .value("FILE");
  command
      .add_option("--picture", arguments->picture,
                  "PNG of what was seen: u and x1 over time, uneven steps, x1 over u (rows in order of time)")
      .value("FILE");
  command.add_flag("--json", arguments->json, "the same JSON on standard output instead of the text");
  command.footer(
      "One line for each question: fine, note (worth knowing) or spoils (the estimates will be wrong or\n"
      "refused), with the figures and, after ->, what to do. Nothing but t, u and x1 is looked at.\n"
      "  time           rows in order, none missing, uniform (for the detector), t in seconds\n"
      "  unit of x1     as declared: rad (m), not counts, degrees or turns\n"
      "  encoder        its step, its noise, the smallest gap that can be read\n"
      "  jumps          wrapped or lost counts, spikes\n"
      "  fresh samples  x1 read again for every row\n"
      "  travel, reversals, speed, standstill   what the motion offers\n"
      "  input, clipping, spectrum              what the input offers\n"
      "  sign, scale of u                       whether u can be what moves x1; what one body would weigh\n"
      "  feedback       whether u answers x1 (what a loop filters away cannot be seen in u and x1)\n"
      "  diagnosis      what `gapscope diagnose` will have to judge by\n"
      "JSON keys carry their units [s, Hz, rad, units of u].\n"
      "Exit status: 0 nothing spoils the estimates, 3 something does, else as for every command.\n\n"
      "Example: gapscope check drive.csv --input i_q --position theta -o drive_check.json");
  command.action([arguments] { check_all(*arguments); });
}

}  // namespace gapscope::cli
