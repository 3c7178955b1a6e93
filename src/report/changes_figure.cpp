#include "report/changes_figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/changes_words.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr double kMarksAside = 0.05;  ///< so that no mark hides the other [reports]

/// A gap or a lost motion that a reading or a fit has told; the answer repeats one of them.
bool is_drawn(const DriveQuantity& q) { return q.is_play() && q.from != "answer"; }

/// One quantity over the reports, bounds as arrows from it to zero.
void add_series(const DriveChanges& all, const DriveQuantity& q, double aside, int place, Panel& panel) {
  static const std::vector<Marker> kMarkers = {Marker::kCircle, Marker::kTriangleUp, Marker::kCross};
  const bool fitted = q.from == "reference";
  const LineStyle style = fitted ? reference_style() : model_free_style();
  Series read, bounds;
  read.label = quantity_name(all, q);
  read.style = {style.colour, style.width, place == 0 ? style.dashes : std::vector<double>{4.0, 8.0}};
  read.joined = q.observed.size() > 2;  // between two a line says nothing
  read.marker = fitted ? Marker::kDisc : kMarkers[static_cast<std::size_t>(place) % kMarkers.size()];
  bounds.label = quantity_name(all, q) + ": at most";
  bounds.style = {kGrey, style.width, {}};
  bounds.marker = Marker::kTriangleDown;
  bounds.joined = false;
  for (std::size_t i = 0; i < q.observed.size(); ++i) {
    const Observation& o = q.observed[i];
    const double x = static_cast<double>(i + 1) + aside;
    read.x.push_back(x);
    read.y.push_back(o.value);
    read.y_intervals.push_back(o.has_value() ? o.ci95 : Interval{});
    if (!std::isfinite(o.at_most)) continue;
    bounds.x.push_back(x);
    bounds.y.push_back(o.at_most);
    bounds.y_intervals.push_back({0.0, o.at_most});
  }
  if (std::ranges::any_of(read.y, [](double y) { return std::isfinite(y); }))
    panel.series.push_back(std::move(read));
  if (!bounds.x.empty()) panel.series.push_back(std::move(bounds));
}

/// " (none of b)": the reports in whose place nothing is drawn.
std::string without_a_gap(const DriveChanges& all, const std::vector<std::string>& names) {
  std::vector<std::string> without;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::none_of(all.quantities, [&](const DriveQuantity& q) {
          return is_drawn(q) && (q.observed[i].has_value() || std::isfinite(q.observed[i].at_most));
        }))
      without.push_back(literal(names[i]));
  return without.empty() ? "" : fmt::format(" (none of {})", fmt::join(without, ", "));
}

Panel plays_over_reports(const DriveChanges& all, const std::vector<std::string>& names) {
  Panel panel{"Estimates with 95 % intervals" + without_a_gap(all, names),
              {"report, in the order given", "", {0.5, static_cast<double>(all.reports.size()) + 0.5}}};
  for (const std::string& name : names)
    panel.x.places.push_back({static_cast<double>(panel.x.places.size() + 1), literal(name)});
  panel.y.unit = all.coordinates.position_unit();
  panel.y.name = "gap $2β$, lost motion";
  panel.height = 560.0;
  const auto drawn = static_cast<int>(std::ranges::count_if(all.quantities, is_drawn));
  int done = 0, levels = 0;
  for (const DriveQuantity& q : all.quantities)
    if (is_drawn(q)) {
      const double aside = kMarksAside * (2.0 * done++ - (drawn - 1));
      add_series(all, q, aside, q.key == "lost_motion" ? ++levels : 0, panel);
    }
  return panel;
}

/// The loops of the torque level that is told first, else of the first level that most reports have.
double level_of_loops(const DriveChanges& all) {
  if (all.lead >= 0)
    if (const double level = all.quantities[static_cast<std::size_t>(all.lead)].level; std::isfinite(level))
      return level;
  double best = kNaN;
  std::ptrdiff_t most = 1;
  for (const DrivenLoop& loop : all.loops) {
    const auto same =
        std::ranges::count_if(all.loops, [&](const DrivenLoop& l) { return l.level == loop.level; });
    if (same > most) most = same, best = loop.level;
  }
  return best;
}

/// Loops of several reports over one another; none where fewer than two have one of that torque.
void add_loops(const DriveChanges& all, const std::vector<std::string>& names, FigureData& figure) {
  static const std::vector<Colour> kColours = {kBlack, kVermillion, kBlue, kGreen, kGrey};
  const double level = level_of_loops(all);
  Panel panel;
  for (const DrivenLoop& l : all.loops) {
    if (l.level != level) continue;
    Series s;
    const auto i = static_cast<std::size_t>(l.report);
    s.label = literal(names[i]);
    s.style = {kColours[i % kColours.size()], 3.5,
               i < kColours.size() ? std::vector<double>{} : std::vector{10.0, 6.0}};
    s.x = l.u, s.y = l.x1;
    panel.series.push_back(std::move(s));
  }
  if (panel.series.size() < 2) return;
  panel.title = "Mean loops over one another";
  panel.x = {
      "input $u$", all.input_unit.empty() ? "units of $u$" : all.coordinates.shown_unit(all.input_unit),
      {},          {},
      {},          {}};
  panel.y.name = "motor position $x_1$, about its middle";
  panel.y.unit = all.coordinates.position_unit();
  panel.height = 560.0;
  figure.panels.push_back(std::move(panel));
}

}  // namespace

FigureData gap_over_recordings(const DriveChanges& all) {
  FigureData figure{"gap_over_recordings.png", "The gap over the recordings"};
  const std::vector<std::string> names = short_names(all.reports);
  Panel plays = plays_over_reports(all, names);
  if (plays.series.empty()) return missing_figure(figure, "no report gives a gap");
  figure.panels.push_back(std::move(plays));
  add_loops(all, names, figure);
  figure.reading = changes_headline(all) + ".";
  return figure;
}

}  // namespace gapscope::internal::report
