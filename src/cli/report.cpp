// `report`: draws a report again from what is stored.
#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"
#include "report/blind_report.h"
#include "report/campaign_report.h"
#include "report/changes_report.h"
#include "results/blind_score.h"
#include "results/campaign_summary.h"
#include "results/diagnosis_result.h"
#include "results/report_folder.h"
#include "results/run_result.h"

namespace gapscope::cli {
namespace {

/// An estimate, a diagnosis or both.
void read_what_is_stored(const std::string& folder) {
  const bool diagnosed = std::filesystem::exists(std::filesystem::path(folder) / "diagnosis.json");
  if (diagnosed) read_diagnosis_result(folder);
  if (!diagnosed || std::filesystem::exists(std::filesystem::path(folder) / "result.json"))
    read_run_result(folder);
}

/// What a folder may hold: how that is told, read and drawn.
struct Kind {
  FolderKind kind;
  bool (*is_in)(const std::string& folder);
  void (*read)(const std::string& folder);
  void (*draw)(const std::string& folder, const std::string& note, const FigureFormats& formats);
};

constexpr Kind kKinds[] = {
    {FolderKind::kCampaign, has_campaign_summary, [](const std::string& f) { read_campaign_summary(f); },
     [](const std::string& f, const std::string&, const FigureFormats& formats) {
       write_campaign_report(f, formats);
     }},
    {FolderKind::kBlind, has_blind_score, [](const std::string& f) { read_blind_score(f); },
     [](const std::string& f, const std::string&, const FigureFormats& formats) {
       write_blind_report(f, formats);
     }},
    {FolderKind::kChanges, has_drive_changes, [](const std::string& f) { read_drive_changes(f); },
     [](const std::string& f, const std::string&, const FigureFormats& formats) {
       write_changes_report(f, formats);
     }},
    {FolderKind::kDrive, [](const std::string&) { return true; }, read_what_is_stored, write_report},
};

/// Draws aside, so that the old report stands until the new one is complete.
void redraw(const std::string& folder, const FigureFormats& formats) {
  const Kind& kind =
      *std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return k.is_in(folder); });
  kind.read(folder);  // so that what is wrong is told with its place in the folder that the user knows
  ReportFolder fresh = ReportFolder::to_redraw(folder, kind.kind);
  std::string note = fresh.dropped();
  if (!fresh.changed().empty()) {
    print_warnings({fresh.changed()});
    note += (note.empty() ? "" : " ") + fresh.changed();
  }
  kind.draw(fresh.path(), note, formats);
  fresh.commit();
}

}  // namespace

void add_report(CommandLine& app) {
  struct ReportArguments {
    std::string folder;
    bool quiet = false, untitled = false;
    FigureFormats figures;
  };
  auto arguments = std::make_shared<ReportArguments>();
  CommandLine command = app.add_command("report", "Draws a report again from its stored results");
  command.add_option("DIR", arguments->folder, "folder of a report").required();
  command.add_flag("--svg", arguments->figures.svg, kSvgHelp);
  command.add_flag("--no-title", arguments->untitled, kUntitledHelp);
  command.add_flag("--small", arguments->figures.small,
                   "each figure at half the size and packed tightly, for a page or a mail");
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer(
      "Reads DIR/result.json, DIR/diagnosis.json [rad, s] and DIR/traces; writes report.md, report.html and "
      "the figures (PNG).\n\n"
      "Example: gapscope report reports/02_experiment");
  command.action([arguments] {
    if (!std::filesystem::is_directory(arguments->folder))
      throw ConfigError(arguments->folder, "there is no such folder, expected the folder of a report");
    progress_on_terminal(arguments->quiet)("drawing " + arguments->folder);
    arguments->figures.title = !arguments->untitled;
    redraw(arguments->folder, arguments->figures);
    fmt::print("{:<12}{}\n", "report", arguments->folder);
  });
}

}  // namespace gapscope::cli
