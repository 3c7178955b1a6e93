#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/figures.h"
#include "report/ticks.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr double kTopDecade = 2.5;  ///< of |e_x|/floor on the colour scale
constexpr double kShows = 2.0;      ///< |e_x|/floor that stands out

/// White at the floor, darker with every decade above it: also in grey, and for the colour-blind.
Colour shade(double decades) {
  static constexpr std::array<Colour, 5> kBlues{
      {{255, 255, 255}, {198, 219, 239}, {107, 174, 214}, {33, 113, 181}, {8, 48, 107}}};
  const double place = std::clamp(decades / kTopDecade, 0.0, 1.0) * (kBlues.size() - 1.0);
  const auto i = std::min(static_cast<std::size_t>(place), kBlues.size() - 2);
  const auto mixed = [&](int a, int b) {
    return static_cast<int>(std::lround(std::lerp(a, b, place - static_cast<double>(i))));
  };
  const Colour &a = kBlues[i], &b = kBlues[i + 1];
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

double level_at(const BoundMap& map, std::size_t column, std::size_t bound) {
  return map.levels[column * map.bounds.size() + bound];
}

Interval time_range(const BoundMap& map) {
  return {map.start, map.start + map.dt * static_cast<double>(map.columns())};
}

/// One tile for a stretch of equal colour in a row.
void add_row(Panel& panel, const BoundMap& map, std::size_t j, double half_step) {
  const double y = std::log10(map.bounds[j]);
  for (std::size_t i = 0; i < map.columns();) {
    const auto colour_of = [&](std::size_t k) {
      return std::lround(20.0 * std::clamp(std::log10(level_at(map, k, j)), 0.0, kTopDecade));
    };
    std::size_t end = i + 1;
    while (end < map.columns() && colour_of(end) == colour_of(i)) ++end;
    panel.tiles.push_back(
        {{map.start + map.dt * static_cast<double>(i), map.start + map.dt * static_cast<double>(end)},
         {y - half_step, y + half_step},
         shade(static_cast<double>(colour_of(i)) / 20.0),
         "",
         kInk});
    i = end;
  }
}

void mark_bound(Panel& panel, double bound, const LineStyle& style, const std::string& label) {
  if (bound > 0.0 && std::log10(bound) >= panel.y.range.low && std::log10(bound) <= panel.y.range.high)
    panel.y_marks.push_back({std::log10(bound), style, label});
}

Panel map_panel(const ReportView& view, const BoundMap& map) {
  Panel panel;
  const double low = std::log10(map.bounds.front()), high = std::log10(map.bounds.back());
  const double half_step = 0.5 * (high - low) / static_cast<double>(map.bounds.size() - 1);
  panel.title = "|$e_x$| over its chatter floor";
  panel.x = view.time_axis(time_range(map));
  panel.y = {
      "bound $L$", view.run.coordinates.shown_unit("rad/s^2"), {low - half_step, high + half_step}, {}, {},
      {}};
  panel.y.places = log_places(panel.y.range, {1.0, 2.0, 5.0});
  panel.height = 760.0;
  for (std::size_t j = 0; j < map.bounds.size(); ++j) add_row(panel, map, j, half_step);
  const GapEstimate& g = *view.run.model_free;
  mark_bound(panel, g.bound, {kVermillion, 4.5, {}},
             g.by_one_bound() ? "$L$ that was used" : "$L$ that decides $t_2$");
  mark_bound(panel, g.bound_t1, {kVermillion, 4.5, {16, 9}}, "$L$ of the $e_x$ drawn");
  mark_bound(panel, g.paper_bound, {kGreen, 4.5, {26, 8, 5, 8}}, "bound (13)");
  return panel;
}

Panel displacement_panel(const ReportView& view, const BoundMap& map) {
  Panel panel{
      "Motor displacement", view.time_axis(time_range(map)), {"$x_1$", view.length_unit}, 260.0, false};
  panel.series.push_back(view.over_time("", measured_style(), view.recording->position(), panel.x.range));
  return panel;
}

Panel scale_panel() {
  Panel panel;
  constexpr double kStep = 0.05;
  for (double d = 0.0; d < kTopDecade - 0.5 * kStep; d += kStep)
    panel.tiles.push_back({{d, d + kStep}, {0.0, 1.0}, shade(d + 0.5 * kStep), "", kInk});
  panel.title = "Scale";
  panel.x = {"|$e_x$| / chatter floor", "", {0.0, kTopDecade}};
  for (const double level : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0})
    panel.x.places.push_back({std::log10(level), fmt::format("{:g}", level)});
  panel.y.range = {0.0, 1.0};
  panel.y.places = {{0.0, ""}};
  panel.height = 44.0;
  return panel;
}

void mark_events(const ReportView& view, const BoundMap& map, Panel& panel, bool named) {
  const Interval range = time_range(map);
  for (const GapEvent& e : view.accepted()) {
    if (!(e.t1 >= range.low && e.t2 <= range.high)) continue;
    panel.x_marks.push_back({e.t1, begin_style(), named ? "$t_1$" : ""});
    panel.x_marks.push_back({e.t2, end_style(), named ? "$t_2$" : ""});
  }
}

/// Highest bound at which e_x stands out at a time; NaN if none does.
double highest_that_shows(const BoundMap& map, double t) {
  const auto column = static_cast<std::size_t>(
      std::clamp((t - map.start) / map.dt, 0.0, static_cast<double>(map.columns() - 1)));
  for (std::size_t j = map.bounds.size(); j-- > 0;)
    if (level_at(map, column, j) > kShows) return map.bounds[j];
  return kNaN;
}

/// Smallest bound at which e_x rests for more than half of the time shown.
double smallest_at_rest(const BoundMap& map) {
  for (std::size_t j = 0; j < map.bounds.size(); ++j) {
    std::size_t quiet = 0;
    for (std::size_t i = 0; i < map.columns(); ++i) quiet += level_at(map, i, j) < kShows;
    if (2 * quiet > map.columns()) return map.bounds[j];
  }
  return kNaN;
}

std::string reading(const ReportView& view, const BoundMap& map) {
  const std::string unit = " " + view.run.coordinates.shown_unit("rad/s^2");
  std::string text =
      fmt::format("e_x rests half of the time from L = {}{} on", rounded(smallest_at_rest(map), 2), unit);
  std::vector<double> passage, impact;
  for (const GapEvent& e : view.accepted())
    if (e.t1 >= map.start && e.t2 < time_range(map).high) {
      passage.push_back(highest_that_shows(map, std::lerp(e.t1, e.t2, 0.8)));
      impact.push_back(highest_that_shows(map, e.t2 + map.dt));
    }
  if (!passage.empty() && std::isfinite(median(passage)) && std::isfinite(median(impact)))
    text += fmt::format("; the passage before an impact shows up to L = {}{}, the impact itself up to {}{}",
                        rounded(median(passage), 2), unit, rounded(median(impact), 2), unit);
  const double paper = view.run.model_free->paper_bound;
  if (std::isfinite(paper)) text += fmt::format("; bound (13) is {}{}", rounded(paper), unit);
  return text + ".";
}

}  // namespace

FigureData bound_time_map(const ReportView& view) {
  FigureData figure{"bound_time_map.png", "What each bound shows"};
  if (!view.recording || !view.run.model_free || !view.run.model_free->map ||
      view.run.model_free->map->file != view.recording->file || view.run.model_free->map->columns() == 0)
    return missing_figure(figure, "no bank of bounds was run over this recording", false);
  const BoundMap& map = *view.run.model_free->map;
  figure.panels = {displacement_panel(view, map), map_panel(view, map), scale_panel()};
  mark_events(view, map, figure.panels[0], true);
  mark_events(view, map, figure.panels[1], false);
  figure.reading = reading(view, map);
  return figure;
}

}  // namespace gapscope::internal::report
