#include "report/panel_plan.h"

#include <cmath>

#include "report/decimate.h"

namespace gapscope::internal::report {
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
    x += needed + 3 * kSpace;
  }
  legend.height = kRow * (row + 1.0) + 2 * kPad;
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

PanelPlan plan_panel(const Panel& panel, const std::string& title, double width, double room,
                     const Typesetter& typesetter) {
  PanelPlan plan;
  plan.width = width;
  plan.height = panel.height;
  plan.x = plan_axis(panel.x, x_range(panel), width, false, typesetter);
  plan.y = plan_axis(panel.y, y_range(panel), panel.height, true, typesetter);
  plan.entries = legend_entries(panel);
  if (!plan.entries.empty()) plan.legend = flowing_legend(plan.entries, room, typesetter);
  plan.title = typesetter.wrapped(title, room, kTextSize, true);
  for (const std::string& line : plan.title)
    plan.above += typesetter.measure(line, kTextSize, true).height() + kTitleGap;
  plan.above += plan.legend.height;
  if (has_mark_labels(panel)) plan.above += 1.35 * kTextSize;
  if (panel.x_labels)
    plan.below =
        kToTicks + 1.1 * kTickSize + kSpace / 2 + typesetter.measure(plan.x.label, kTextSize).height();
  return plan;
}

}  // namespace gapscope::internal::report
