#include "report/panel_plan.h"

#include <cmath>

#include "report/decimate.h"
#include "report/legend_placement.h"

namespace gapscope::internal {
namespace {

constexpr double kRow = 1.32 * kTextSize;  // of a legend
constexpr double kPad = 12.0;              // within a legend

double entry_width(const LegendEntry& entry, const Typesetter& typesetter) {
  return kSample + kSpace + typesetter.measure(entry.label, kTextSize).width;
}

bool never_falls(const std::vector<double>& x) { return std::is_sorted(x.begin(), x.end()); }

/// Pieces of the series between undefined points, as indices [begin, end).
std::vector<std::pair<std::size_t, std::size_t>> pieces_of(const Series& s) {
  std::vector<std::pair<std::size_t, std::size_t>> pieces;
  const auto defined = [&](std::size_t i) { return std::isfinite(s.x[i]) && std::isfinite(s.y[i]); };
  for (std::size_t i = 0; i < s.x.size();) {
    if (!defined(i)) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < s.x.size() && defined(i)) ++i;
    pieces.emplace_back(begin, i);
  }
  return pieces;
}

bool has_mark_labels(const Panel& panel) {
  return std::any_of(panel.x_marks.begin(), panel.x_marks.end(),
                     [](const Mark& m) { return !m.label.empty(); });
}

/// Error bars and markers are data, too.
void add_points(const Panel& panel, PanelPlan& plan) {
  constexpr double kMarker = 16.0;
  for (const Series& s : panel.series) {
    for (std::size_t i = 0; i < s.x_intervals.size(); ++i)
      plan.lines.push_back(
          {plan.place(s.x_intervals[i].low, s.y[i]), plan.place(s.x_intervals[i].high, s.y[i])});
    for (std::size_t i = 0; i < s.y_intervals.size(); ++i)
      plan.lines.push_back(
          {plan.place(s.x[i], s.y_intervals[i].low), plan.place(s.x[i], s.y_intervals[i].high)});
    if (s.marker == Marker::kNone) continue;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const Point p = plan.place(s.x[i], s.y[i]);
      plan.lines.push_back({{p.x - kMarker, p.y - kMarker}, {p.x + kMarker, p.y + kMarker}});
    }
  }
}

void add_marks(const Panel& panel, PanelPlan& plan) {
  for (const Mark& mark : panel.x_marks) {
    const double x = plan.place(mark.at, 0.0).x;
    plan.lines.push_back({{x, 0.0}, {x, plan.height}});
  }
  for (const Band& band : panel.y_bands)
    for (const double at : {band.range.low, (band.range.low + band.range.high) / 2, band.range.high}) {
      const double y = plan.place(0.0, at).y;
      plan.lines.push_back({{0.0, y}, {plan.width, y}});
    }
  for (const Mark& mark : panel.y_marks) {
    const double y = plan.place(0.0, mark.at).y;
    plan.lines.push_back({{0.0, y}, {plan.width, y}});
  }
}

/// Inside where it hides nothing, else in rows above the frame.
void place_legend(PanelPlan& plan, bool filled, const Typesetter& typesetter) {
  if (plan.entries.empty()) return;
  plan.legend = flowing_legend(plan.entries, plan.width, typesetter);
  if (filled) return;  // a map leaves no empty place
  const Box frame{0.0, 0.0, plan.width, plan.height};
  for (Legend legend : {stacked_legend(plan.entries, typesetter),
                        flowing_legend(plan.entries, plan.width - 4 * kSpace, typesetter)}) {
    const auto box = empty_place(frame, legend.box.width, legend.box.height, kSpace, plan.lines);
    if (!box) continue;
    plan.legend = legend;
    plan.legend.box = *box;
    plan.legend_inside = true;
    return;
  }
}

}  // namespace

std::vector<LegendEntry> legend_entries(const Panel& panel) {
  std::vector<LegendEntry> entries;
  for (const Series& s : panel.series)
    if (!s.label.empty()) entries.push_back({s.label, s.style, s.marker, s.joined, false});
  for (const Mark& mark : panel.y_marks)
    if (!mark.label.empty()) entries.push_back({mark.label, mark.style, Marker::kNone, true, false});
  for (const auto* bands : {&panel.x_bands, &panel.y_bands})
    for (const Band& band : *bands)
      if (!band.label.empty())
        entries.push_back({band.label, {band.colour, 0.0, {}}, Marker::kNone, false, true});
  return entries;
}

Legend stacked_legend(const std::vector<LegendEntry>& entries, const Typesetter& typesetter) {
  Legend legend;
  for (const LegendEntry& entry : entries) {
    legend.places.push_back(
        {kPad, kPad + kRow * static_cast<double>(legend.places.size()) + 0.95 * kTextSize});
    legend.box.width = std::max(legend.box.width, entry_width(entry, typesetter) + 2 * kPad);
  }
  legend.box.height = kRow * static_cast<double>(entries.size()) + 2 * kPad;
  return legend;
}

Legend flowing_legend(const std::vector<LegendEntry>& entries, double width, const Typesetter& typesetter) {
  Legend legend;
  double x = kPad, row = 0.0;
  for (const LegendEntry& entry : entries) {
    const double needed = entry_width(entry, typesetter);
    if (x > kPad && x + needed + kPad > width) {
      x = kPad;
      row += 1.0;
    }
    legend.places.push_back({x, kPad + kRow * row + 0.95 * kTextSize});
    legend.box.width = std::max(legend.box.width, x + needed + kPad);
    x += needed + 3 * kSpace;
  }
  legend.box.height = kRow * (row + 1.0) + 2 * kPad;
  return legend;
}

std::vector<Polyline> polylines_of(const Series& s, const PanelPlan& plan) {
  std::vector<Polyline> lines;
  if (!s.joined) return lines;
  const bool monotone = never_falls(s.x);
  for (const auto& [begin, end] : pieces_of(s)) {
    const std::span x(s.x.data() + begin, end - begin), y(s.y.data() + begin, end - begin);
    Polyline line;
    if (monotone) {
      for (const std::size_t i : decimate_columns(x, y, static_cast<std::size_t>(plan.width)))
        line.push_back(plan.place(x[i], y[i]));
    } else {
      for (std::size_t i = 0; i < x.size(); ++i) line.push_back(plan.place(x[i], y[i]));
      line = thin_out(line, 0.5);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

PanelPlan plan_panel(const Panel& panel, const std::string& title, double width,
                     const Typesetter& typesetter) {
  PanelPlan plan;
  plan.width = width;
  plan.height = panel.height;
  plan.x = plan_axis(panel.x, x_range(panel), width, false, typesetter);
  plan.y = plan_axis(panel.y, y_range(panel), panel.height, true, typesetter);
  for (const Series& s : panel.series)
    for (Polyline& line : polylines_of(s, plan)) plan.lines.push_back(std::move(line));
  add_points(panel, plan);
  add_marks(panel, plan);
  plan.entries = legend_entries(panel);
  place_legend(plan, !panel.tiles.empty(), typesetter);
  if (!title.empty()) plan.above += typesetter.measure(title, kTextSize, true).height() + kTitleGap;
  if (!plan.entries.empty() && !plan.legend_inside) plan.above += plan.legend.box.height;
  if (has_mark_labels(panel)) plan.above += 1.35 * kTextSize;
  if (panel.x_labels)
    plan.below = kSpace + 1.1 * kTickSize + kSpace / 2 + typesetter.measure(plan.x.label, kTextSize).height();
  return plan;
}

}  // namespace gapscope::internal
