#include "gapscope/report/changes_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "report/changes_figure.h"
#include "report/markdown.h"
#include "report/report_files.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope {
namespace internal::report {
namespace {

constexpr double kLabelAside = 0.06;  ///< so that no mark hides the other

bool is_gap(const DriveQuantity& q) { return q.key == "gap" || q.key == "play_at_zero_torque"; }

std::string unit_of(const DriveChanges& all, const DriveQuantity& q) {
  return all.coordinates.shown_unit(q.unit);
}

std::string estimator(const DriveQuantity& q) { return q.from == "model_free" ? "model-free" : "reference"; }

std::string observed_text(const Observation& o, const std::string& unit) {
  if (o.remark.empty()) return plus_minus(o.value, o.ci95, unit);
  return std::isfinite(o.ci95.high) ? "none above " + quantity(o.ci95.high, unit) : o.remark;
}

std::string change_text(const Change& c, const std::string& unit) {
  const std::string verdict = to_string(c.verdict);
  if (std::isfinite(c.difference))
    return (c.difference > 0.0 ? "+" : "") + plus_minus(c.difference, c.ci95, unit) + ", " + verdict;
  if (!std::isfinite(c.ci95.low)) return verdict;
  return interval_text(c.ci95, unit) + ", " + verdict;
}

/// The last parts of the folders' names where these tell them apart, else the whole.
std::vector<std::string> short_names(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    const std::filesystem::path path = std::filesystem::path(folder + "/").lexically_normal().parent_path();
    names.push_back(path.filename().string());
  }
  return std::set<std::string>(names.begin(), names.end()).size() == names.size() ? names : folders;
}

/// One estimator's readings; of a gap that was denied the smallest that would have shown, as an upper limit.
/// @param aside  of its reports' names: beside another estimator's
void add_series(const DriveQuantity& q, double aside, Panel& panel) {
  const bool model_free = q.from == "model_free", play = q.key != "gap";
  const LineStyle style = model_free ? model_free_style() : reference_style();
  Series read, denied;
  read.label = estimator(q) + (play ? " (play at zero torque)" : "");
  read.style = {style.colour, style.width, play ? std::vector<double>{4.0, 8.0} : style.dashes};
  read.joined = q.observed.size() > 2;  // between two a line says nothing
  read.marker = !model_free ? Marker::kCircle : play ? Marker::kTriangleUp : Marker::kDisc;
  denied.label = estimator(q) + (play ? ": no play above" : ": none above");
  denied.style = {kGrey, style.width, {}};
  denied.marker = Marker::kTriangleDown;
  denied.joined = false;
  for (std::size_t i = 0; i < q.observed.size(); ++i) {
    const Observation& o = q.observed[i];
    const double x = static_cast<double>(i + 1) + aside;
    read.x.push_back(x);
    read.y.push_back(o.value);
    read.y_intervals.push_back(o.remark.empty() ? o.ci95 : Interval{});
    if (o.remark.empty() || !std::isfinite(o.ci95.high)) continue;
    denied.x.push_back(x);
    denied.y.push_back(o.ci95.high);
    denied.y_intervals.push_back(o.ci95);
  }
  panel.series.push_back(std::move(read));
  if (!denied.x.empty()) panel.series.push_back(std::move(denied));
}

/// " (none of b)": the reports in whose place nothing is drawn.
std::string without_a_gap(const DriveChanges& all, const std::vector<std::string>& names) {
  std::vector<std::string> without;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::none_of(all.quantities.begin(), all.quantities.end(), [&](const DriveQuantity& q) {
          return is_gap(q) && (std::isfinite(q.observed[i].value) || std::isfinite(q.observed[i].ci95.high));
        }))
      without.push_back(literal(names[i]));
  return without.empty() ? "" : fmt::format(" (none of {})", fmt::join(without, ", "));
}

std::string reading_of(const DriveChanges& all) {
  std::string text;
  for (const DriveQuantity& q : all.quantities)
    if (is_gap(q))
      text += fmt::format("{}{}{}: {} since {}", text.empty() ? "" : "; ", estimator(q),
                          q.key == "gap" ? "" : " (play at zero torque)",
                          change_text(q.changes.back(), unit_of(all, q)), all.reports.front());
  return text + ".";
}

}  // namespace

FigureData gap_over_recordings(const DriveChanges& all) {
  FigureData figure;
  figure.file = "gap_over_recordings.png";
  figure.title = "The gap over the recordings";
  Panel panel;
  const std::vector<std::string> names = short_names(all.reports);
  panel.title = "Estimates with 95 % intervals" + without_a_gap(all, names);
  panel.x = {
      "report, in the order given", "", {0.5, static_cast<double>(all.reports.size()) + 0.5}, {}, {}, {}};
  for (const std::string& name : names)
    panel.x.places.push_back({static_cast<double>(panel.x.places.size() + 1), literal(name)});
  panel.y.unit = all.coordinates.position_unit();
  const auto gaps = std::count_if(all.quantities.begin(), all.quantities.end(), is_gap);
  for (const DriveQuantity& q : all.quantities)
    if (is_gap(q)) add_series(q, gaps < 2 ? 0.0 : q.from == "model_free" ? -kLabelAside : kLabelAside, panel);
  const bool plays = all.find("model_free", "play_at_zero_torque") != nullptr;
  panel.y.name = plays ? "backlash gap $2β$, play" : "backlash gap $2β$";
  panel.height = 620.0;
  if (panel.series.empty()) return missing_figure(figure.file, figure.title, "no report tells a gap");
  figure.panels.push_back(std::move(panel));
  figure.reading = reading_of(all);
  return figure;
}

namespace {

std::string quantity_section(const DriveChanges& all, const DriveQuantity& q) {
  const std::string unit = unit_of(all, q);
  std::string text = fmt::format(
      "\n### `{}`, {}\n\n| report | value (± half of the 95 % interval) | since {} |\n|---|---|---|\n", q.key,
      estimator(q), all.reports.front());
  for (std::size_t i = 0; i < q.observed.size(); ++i)
    text += fmt::format("| {} | {} | {} |\n", all.reports[i], observed_text(q.observed[i], unit),
                        i == 0 ? "" : change_text(q.changes[i - 1], unit));
  return text;
}

int changed(const DriveChanges& all) {
  int count = 0;
  for (const DriveQuantity& q : all.quantities)
    count += static_cast<int>(std::count_if(q.changes.begin(), q.changes.end(), [](const Change& c) {
      return c.verdict == ChangeVerdict::kChanged;
    }));
  return count;
}

std::string summary_line(const DriveChanges& all) {
  if (all.compared == 0)
    return "No quantity has a value both in " + all.reports.front() +
           " and in another report: nothing to compare";
  return fmt::format(
      "{} of {} differences from {} are more than the intervals carry, all taken together at 5 %",
      changed(all), all.compared, all.reports.front());
}

std::string comparison_text(const DriveChanges& all, const std::vector<FigureData>& figures) {
  std::string text =
      fmt::format("# {} reports of one drive\n\n**{}.**\n", all.reports.size(), summary_line(all));
  text +=
      "\nIntervals are those of single recordings. What a drive does differently from day to day "
      "(temperature,\n"
      "grease, where it stands) is not in them: a change that was not looked for should be seen again.\n";
  text += bullet_section("Warnings", all.warnings) + figure_section(figures) + "\n## Quantities\n";
  for (const DriveQuantity& q : all.quantities) text += quantity_section(all, q);
  if (all.quantities.empty()) text += "\nNo report tells one.\n";
  return text + fmt::format("\ngapscope {}\n", all.version);
}

}  // namespace
}  // namespace internal::report

std::string changes_text(const DriveChanges& all) {
  std::size_t widest = 0;
  for (const std::string& report : all.reports) widest = std::max(widest, report.size());
  std::string text;
  for (const DriveQuantity& q : all.quantities) {
    const std::string unit = internal::report::unit_of(all, q);
    text += fmt::format("{} ({})\n", q.key, internal::report::estimator(q));
    for (std::size_t i = 0; i < q.observed.size(); ++i) {
      const std::string value = internal::report::observed_text(q.observed[i], unit);
      text += i == 0 ? fmt::format("  {:<{}}  {}\n", all.reports[i], widest, value)
                     : fmt::format("  {:<{}}  {:<28}  {}\n", all.reports[i], widest, value,
                                   internal::report::change_text(q.changes[i - 1], unit));
    }
  }
  return text + internal::report::summary_line(all) + "\n";
}

void write_changes_report(const std::string& folder, const FigureFormats& formats) {
  const DriveChanges all = read_drive_changes(folder);
  const std::vector<internal::report::FigureData> figures = {internal::report::gap_over_recordings(all)};
  internal::report::write_report_files(folder, figures, internal::report::comparison_text(all, figures),
                                       formats, {"Reports of one drive"});
}

}  // namespace gapscope
