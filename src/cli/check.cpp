// `check`: what a recording is worth before anything is estimated from it.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/config/configuration.h"
#include "gapscope/inspection/inspection.h"
#include "gapscope/results/inspection_result.h"

namespace gapscope::cli {
namespace {

struct CheckArguments {
  RecordingArguments recording;
  std::string output;
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

bool check_recording(const CheckArguments& a, const RecordingArguments& r) {
  const auto look = [&] { return require_file_name(a.output, {r.file}, is_inspection_file); };
  if (!a.output.empty()) look();  // before the work
  const Configuration c = reading_of(r);
  const Inspection inspection =
      inspect(r.file, c.recording->reading_for(UnevenRows::kRefused), c.coordinates);
  const std::string json = inspection_json(inspection, resolved_reading(c));
  if (!a.output.empty()) write_text(a.output, json, look());
  fmt::print("{}", a.json ? json : inspection.report());
  return inspection.spoilt();
}

void check_axes(const CheckArguments& a) {
  const auto all = a.recording.each_axis();
  if (all.size() > 1 && (a.json || !a.output.empty()))
    throw ConfigError(
        "gapscope: --axis all has a report for each axis, expected one axis with --json and --output");
  bool spoilt = false;
  for (const RecordingArguments& one : all) {
    if (all.size() > 1)
      fmt::print("{}axis        {}\n", &one == all.data() ? "" : "\n", printable(one.axis, 60));
    spoilt |= check_recording(a, one);
  }
  if (spoilt) throw ExitStatus{kSpoiltRecording};
}

}  // namespace

void add_check(CommandLine& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CommandLine command = app.add_command("check", "What a recording is worth: look before you estimate");
  add_recording_arguments(command, arguments->recording);
  command.add_option("-o,--output", arguments->output, "file to write the findings into (JSON)")
      .value("FILE");
  command.add_flag("--json", arguments->json, "the same JSON on standard output instead of the text");
  command.footer(
      "One line for each question: fine, note (worth knowing) or spoils (the estimates will be wrong or\n"
      "refused), with the figures and, after ->, what to do. Nothing but t, u and x1 is looked at.\n"
      "  time           rows in order, none missing, uniform (for the detector), t in seconds\n"
      "  unit of x1     as declared: rad (m), not counts, degrees or turns\n"
      "  encoder        its step, its noise, the smallest gap that can be read\n"
      "  jumps          wrapped or lost counts, spikes\n"
      "  fresh samples  x1 read anew for every row\n"
      "  travel, reversals, speed, standstill   what the motion offers\n"
      "  input, clipping, spectrum              what the input offers\n"
      "  sign, scale of u                       whether u can be what moves x1; what one body would weigh\n"
      "  feedback       whether u answers x1 (what a loop filters away cannot be told from u and x1)\n"
      "  diagnosis      what `gapscope diagnose` will have to judge by\n"
      "JSON keys carry their units [s, Hz, rad, units of u].\n"
      "Exit status: 0 nothing spoils the estimates, 3 something does, else as for every command.\n\n"
      "Example: gapscope check drive.csv --input i_q --position theta -o drive_check.json");
  command.action([arguments] { check_axes(*arguments); });
}

}  // namespace gapscope::cli
