#include "report/changes_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/changes_figure.h"
#include "report/changes_words.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {
namespace internal::report {
namespace {

std::string quantity_section(const DriveChanges& all, const DriveQuantity& q) {
  const std::string unit = changes_unit(all, q);
  std::string text =
      fmt::format("\n### {}\n\n| report | value (± half of the 95 % interval) | since {} |\n|---|---|---|\n",
                  quantity_name(all, q), all.reports.front());
  for (std::size_t i = 0; i < q.observed.size(); ++i)
    text += fmt::format("| {} | {} | {} |\n", all.reports[i], observed_text(q.observed[i], unit),
                        i == 0 ? "" : change_text(q.changes[i - 1], unit));
  return text;
}

/// First against last, a quantity a row.
std::string table(const DriveChanges& all) {
  std::string text = fmt::format("| quantity | {} | {} | difference |\n|---|---|---|---|\n",
                                 all.reports.front(), all.reports.back());
  for (const DriveQuantity& q : all.quantities) {
    const std::string unit = changes_unit(all, q);
    text +=
        fmt::format("| {} | {} | {} | {} |\n", quantity_name(all, q), observed_text(q.observed.front(), unit),
                    observed_text(q.observed.back(), unit), change_text(q.changes.back(), unit));
  }
  return text;
}

std::string comparison_text(const DriveChanges& all, const std::vector<FigureData>& figures) {
  std::string text = fmt::format("# {} reports of one drive\n\n**{}.**\n\n{}.\n", all.reports.size(),
                                 changes_headline(all), changes_count(all));
  if (const std::string which = which_text(all); !which.empty()) text += "\n" + which + ".\n";
  text += bullet_section(all.order == ReportOrder::kUnits ? "Units" : "Over the reports", order_lines(all));
  text += bullet_section("Warnings", all.warnings) + figure_section(figures) + "\n## Quantities\n\n";
  text += all.quantities.empty() ? "No report gives one.\n" : table(all);
  text +=
      "\nThe interval of a difference is that of this row alone; a verdict considers all rows together. Intervals\n"
      "are those of single recordings: what a drive does differently from day to day (temperature, grease,\n"
      "where it stands) is not in them, so a change that was not looked for should be seen again.\n";
  if (all.reports.size() > 2)
    for (const DriveQuantity& q : all.quantities) text += quantity_section(all, q);
  return text + fmt::format("\ngapscope {}\n", all.version);
}

bool is_code(const DriveChanges& all, const char* kind) {
  return std::any_of(all.codes.begin(), all.codes.end(),
                     [&](const std::string& code) { return code.starts_with(kind); });
}

/// The picture carries the answer; the badge says how far it goes.
PageHead page_head(const DriveChanges& all, const FigureData& figure) {
  const bool changed = is_code(all, "changed.") || is_code(all, "since.") || is_code(all, "came.") ||
                       is_code(all, "went.") || is_code(all, "odd.");
  PageHead head{"What changed", fmt::format("{} reports, gapscope {}", all.reports.size(), all.version)};
  head.badges.push_back(changed ? Badge{"good", "changed"} : Badge{"open", "no change seen"});
  if (figure.missing.empty()) head.carrying = figure.file;
  return head;
}

}  // namespace
}  // namespace internal::report

std::string changes_text(const DriveChanges& all) {
  using namespace internal::report;
  std::size_t widest = 0;
  for (const std::string& report : all.reports) widest = std::max(widest, report.size());
  std::string text = changes_headline(all) + ".\n";
  if (const std::string which = which_text(all); !which.empty()) text += which + ".\n";
  for (const std::string& line : order_lines(all)) text += "  " + line + "\n";
  text += "\n";
  for (const DriveQuantity& q : all.quantities) {
    const std::string unit = changes_unit(all, q);
    text += quantity_name(all, q) + "\n";
    for (std::size_t i = 0; i < q.observed.size(); ++i) {
      const std::string value = observed_text(q.observed[i], unit);
      text += i == 0 ? fmt::format("  {:<{}}  {}\n", all.reports[i], widest, value)
                     : fmt::format("  {:<{}}  {:<28}  {}\n", all.reports[i], widest, value,
                                   change_text(q.changes[i - 1], unit));
    }
  }
  return text + changes_count(all) + "\n";
}

void write_changes_report(const std::string& folder, const FigureFormats& formats) {
  using namespace internal::report;
  const DriveChanges all = read_drive_changes(folder);
  const std::vector<FigureData> figures = {gap_over_recordings(all)};
  write_report_files(folder, figures, comparison_text(all, figures), formats,
                     page_head(all, figures.front()));
}

}  // namespace gapscope
