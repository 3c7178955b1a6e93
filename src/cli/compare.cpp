// `compare`: the same drive in several reports.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "base/interrupt.h"
#include "changes/changes.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"
#include "report/changes_report.h"
#include "results/report_folder.h"

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

/// What belongs to a report that was never made is named, with the commands that make it.
void require_report(const std::string& folder) {
  if (fs::is_regular_file(folder))
    throw ConfigError(folder,
                      "is a file, expected the folder of a report: that of `gapscope run`, detect, fit or "
                      "diagnose of a configuration, reports/NAME if no other was asked for");
  if (!fs::is_directory(folder) || fs::exists(folder + "/result.json") ||
      fs::exists(folder + "/diagnosis.json"))
    return;
  const std::string path = fs::path(folder + "/").lexically_normal().parent_path().string();
  throw ConfigError(
      folder, fmt::format("has no result.json, expected the folder of a report. If it holds recordings: "
                          "`gapscope init {0}/* -o {0}.yaml`, then `gapscope run {0}.yaml` (or detect), "
                          "and compare reports/{1}",
                          path, fs::path(path).filename().string()));
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
    require_report(folder);
    reports.push_back(read_drive_report(folder));
  }
  const DriveChanges all = changes(reports, a.spread ? ReportOrder::kUnits : ReportOrder::kInTime);
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
  command.add_option("DIR", arguments->folders, "folders of run, detect, fit or diagnose, in order of time")
      .required()
      .values(2);
  command
      .add_option("-o,--output", arguments->output, "folder of the comparison (default: nothing is written)")
      .value("DIR");
  command.add_flag(
      "--spread", arguments->spread,
      "the reports are of several axes or units: how far they lie apart, beside how far a fit does");
  command.footer(
      "Reads DIR/result.json, DIR/diagnosis.json and what belongs to them, and sets every quantity against\n"
      "the first report: the gap of the answer and of each source, the lost motion, friction and stiffness of\n"
      "the loop by torque level, every number that a fit has estimated, the missing torque and the amount of\n"
      "every effect that a diagnosis has added. A bound against a value is a comparison, too.\n"
      "  changed  more than the errors of both, and what other torques alone can make, leave room for\n"
      "  same     within the tolerance: tolerance: {gap: ...} of a report for gap and lost motion, else a\n"
      "           tenth of the larger value\n"
      "  open     the errors leave room for either\n"
      "The first line is the change that matters most. All rows share one error rate: with n differences\n"
      "each interval is as wide as 1 - 0.05/n holds (Bonferroni), so that a word of any row is wrong in at\n"
      "most one comparison of twenty; the printed interval of a row is its own 95 %.\n"
      "Of two fits it says which numbers must differ, with those that look alike, and what a joint fit of both\n"
      "is off by on what it has not seen, with and without them; of four reports or more, in order, the course\n"
      "of each quantity and since when it is not what it was; of units (--spread) those that are unlike the\n"
      "others.\n"
      "Warned of: other numbers given, another excitation, encoder or method, the same recording twice, a\n"
      "model that leaves more than the encoder explains, a result that was changed since it was written.\n"
      "Numbers of a rejected model are left out.\n"
      "Intervals are those of single recordings; what a drive does differently from day to day is not in\n"
      "them, so see a small change twice before you believe it.\n"
      "Writes compare.json (units in the keys; rad means m on a translational axis), report.md,\n"
      "report.html and gap_over_recordings.png into the folder of -o.\n\n"
      "Example: gapscope compare reports/march reports/june reports/june_repaired -o reports/2026");
  command.action([arguments] { compare(*arguments); });
}

}  // namespace gapscope::cli
