// `compare`: the same drive in several reports.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/report/changes_report.h"
#include "gapscope/results/report_folder.h"

namespace gapscope::cli {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  std::vector<std::string> folders;
  std::string output;
  bool spread = false;
};

/// A comparison that went into one of its reports would remove that report.
void require_another_folder(const CompareArguments& a) {
  for (const std::string& folder : a.folders)
    if (fs::exists(a.output) && fs::exists(folder) && fs::equivalent(a.output, folder))
      throw ConfigError(a.output, "is one of the reports itself, expected another folder for the comparison");
}

void write_comparison(ReportFolder& report, const DriveChanges& all) {
  write_drive_changes(report.path(), all);
  write_changes_report(report.path());
  stop_point();
  report.commit();
}

void compare(const CompareArguments& a) {
  if (!a.output.empty()) require_another_folder(a);
  std::optional<ReportFolder> report;
  if (!a.output.empty()) report.emplace(a.output, FolderKind::kChanges);
  std::vector<DriveReport> reports;
  for (const std::string& folder : a.folders) {
    stop_point();
    reports.push_back(read_drive_report(folder));
  }
  const DriveChanges all = changes(reports);
  if (report) write_comparison(*report, all);
  print_warnings(all.warnings);
  if (!a.output.empty()) fmt::print("{:<12}{}\n", "report", a.output);
  fmt::print("{}", a.spread ? spread_text(all) : changes_text(all));
}

}  // namespace

void add_compare(CommandLine& app) {
  auto arguments = std::make_shared<CompareArguments>();
  CommandLine command =
      app.add_command("compare", "The same drive in several reports: over months, before and after a repair");
  command.add_option("DIR", arguments->folders, "folders of run, detect or fit, in order of time")
      .required()
      .values(2);
  command
      .add_option("-o,--output", arguments->output, "folder of the comparison (default: nothing is written)")
      .value("DIR");
  command.add_flag(
      "--spread", arguments->spread,
      "the reports are of several axes or units: how far they lie apart, beside how far a fit does");
  command.footer(
      "Reads DIR/result.json and what belongs to it: the model-free gap and every parameter that a "
      "reference\n"
      "has estimated, and sets each against the first report. The interval of a difference is that of both\n"
      "standard errors together, 1.96 sqrt(s^2 + s^2). `changed` is what is more than chance at 5 % for all\n"
      "comparisons taken together (Holm); `not beyond chance`: its own interval leaves zero out, but so "
      "would\n"
      "one in twenty; a gap that was denied may be anything up to the smallest that would have shown.\n"
      "Warned of: other numbers given, another excitation, encoder or method, the same recording twice, a\n"
      "model that leaves more than the encoder explains, a result that was changed since it was written.\n"
      "Numbers of a rejected model are left out.\n"
      "Intervals are those of single recordings; what a drive does differently from day to day is not in\n"
      "them, so see a small change twice before you believe it.\n"
      "Writes compare.json (units in the keys; rad means m on a translational axis), report.md and\n"
      "gap_over_recordings.png into the folder of -o.\n\n"
      "Example: gapscope compare reports/march reports/june reports/june_repaired -o reports/2026");
  command.action([arguments] { compare(*arguments); });
}

}  // namespace gapscope::cli
