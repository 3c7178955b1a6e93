
#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "report/figures.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr Interval kNone{};

bool is_denied(const ReportView& view) {
  return view.run.model_free && view.run.model_free->verdict == GapVerdict::kNone &&
         std::isfinite(view.run.model_free->none_above());
}

bool is_play(const ReportView& view) {
  return view.run.model_free && view.run.model_free->quantity == GapQuantity::kPlayAtZeroTorque;
}

/// One row of the upper panel.
void add_row(Panel& panel, const std::string& name, double value, const Interval& ci95,
             const LineStyle& style, Marker marker, const std::string& remark) {
  const double row = static_cast<double>(panel.y.categories.size());
  panel.y.categories.push_back(name);
  panel.y.remarks.push_back(remark);
  if (!std::isfinite(value)) return;
  Series s;
  s.style = {style.colour, style.width, {}};
  s.marker = marker;
  s.joined = false;
  s.x = {value};
  s.y = {row};
  if (std::isfinite(ci95.low) && std::isfinite(ci95.high)) s.x_intervals = {ci95};
  panel.series.push_back(s);
}

void add_model_free(const ReportView& view, Panel& panel) {
  if (!view.run.model_free) return;
  const GapEstimate& g = *view.run.model_free;
  std::string remark = plus_minus(g.gap, g.ci95, view.length_unit);
  if (std::isfinite(g.gap) && g.method == GapMethod::kLiteral)
    remark += ", scatter " + quantity(g.std, view.length_unit);
  if (g.verdict == GapVerdict::kInconclusive) remark = "inconclusive";
  if (g.verdict == GapVerdict::kNone) remark = "none above " + quantity(g.none_above(), view.length_unit);
  const LostMotion& m = g.lost_motion;
  if (!std::isfinite(g.gap) && m.read()) {  // measured, whatever it means
    const bool levels = m.levels.size() > 1;
    const Interval range = levels ? m.range() : m.ci95;
    add_row(panel, "model-free", m.value, range, model_free_style(), Marker::kCircle,
            "lost motion " + (levels ? interval_text(range, view.length_unit) + " by level"
                                     : plus_minus(m.value, range, view.length_unit)));
    return;
  }
  add_row(panel, "model-free", g.gap, g.ci95, model_free_style(), Marker::kDisc, remark);
}

/// S1 to S6 as printed: no interval, the scatter of its passages.
void add_literal(const ReportView& view, Panel& panel) {
  if (!view.run.literal) return;
  const GapEstimate& g = *view.run.literal;
  const std::string remark = std::isfinite(g.gap) ? quantity(g.gap, view.length_unit) + ", scatter " +
                                                        quantity(g.std, view.length_unit)
                                                  : "inconclusive";
  add_row(panel, "literal", g.gap, {}, literal_style(), Marker::kCircle, remark);
}

void add_reference(const ReportView& view, Panel& panel) {
  const FittedParameter* gap = parameter(view.run, "gap");
  if (gap == nullptr) return;
  const Interval ci95 = view.run.reference->shown_interval(*gap);
  std::string remark = plus_minus(gap->value, ci95, view.length_unit);
  if (!gap->estimated) remark = quantity(gap->value, view.length_unit) + ", given";
  if (gap->estimated && !gap->identifiable) remark = "not identifiable";
  const bool rejected = gap->estimated && view.run.reference->rejected();
  if (rejected) remark = quantity(gap->value, view.length_unit) + ", model rejected";
  add_row(panel, "fitted model", gap->value, ci95, rejected ? LineStyle{kGrey, 4.0, {}} : reference_style(),
          rejected ? Marker::kCross : Marker::kCircle, remark);
}

void add_truth(const ReportView& view, Panel& panel) {
  const double map = view.run.comparison ? view.run.comparison->map_width : kNaN;
  if (std::isfinite(map))
    add_row(panel, "$x_1$–$x_2$ map", map, kNone, {kBlack, 4.0, {}}, Marker::kTriangleUp,
            quantity(map, view.length_unit));
  if (std::isfinite(view.run.simulated_gap))
    add_row(panel, "simulated", view.run.simulated_gap, kNone, {kGrey, 4.0, {}}, Marker::kTriangleDown,
            quantity(view.run.simulated_gap, view.length_unit));
  if (std::isfinite(view.true_gap())) panel.x_marks.push_back({view.true_gap(), truth_style(), ""});
}

Panel side_by_side(const ReportView& view) {
  Panel panel{"Estimates with 95 % intervals",
              {is_play(view) ? "play at zero torque, gap" : "backlash gap $2β$", view.length_unit}};
  add_model_free(view, panel);
  add_literal(view, panel);
  add_reference(view, panel);
  add_truth(view, panel);
  panel.height = 90.0 + 85.0 * static_cast<double>(panel.y.categories.size());
  return panel;
}

Interval interval_of(const GapEvent& e) {
  const double half = std::isfinite(e.std) ? kNormal95 * e.std : 0.0;
  return {e.gap - half, e.gap + half};
}

/// Room for what was accepted and what it means, intervals included, or from nothing to the gap that would
/// have shown; a passage that was set aside may lie beyond.
Interval event_range(const ReportView& view) {
  std::vector<GapEvent> shown = view.accepted();
  if (shown.empty()) shown = view.events;
  std::vector<double> values;
  for (const GapEvent& e : shown)
    for (const double v : {interval_of(e).low, interval_of(e).high})
      if (std::isfinite(v)) values.push_back(v);
  const Interval& ci = view.run.model_free->ci95;
  for (const double v : {ci.low, ci.high, view.true_gap()})
    if (std::isfinite(v)) values.push_back(v);
  if (is_denied(view)) values.insert(values.end(), {0.0, view.run.model_free->none_above()});
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double room = std::max(0.1 * (*high - *low), 0.01 * std::abs(*high));
  return {*low - room, *high + room};
}

Series passages(const ReportView& view, const std::string& label, int direction, bool accepted,
                Marker marker) {
  Series s;
  s.label = label;
  s.style = {accepted ? kVermillion : kGrey, 4.0, {}};
  s.marker = marker;
  s.joined = false;
  const Interval range = event_range(view);
  for (const GapEvent& e : view.events) {
    const bool same = accepted ? e.accepted && e.direction == direction : !e.accepted;
    if (!same || !(e.gap >= range.low && e.gap <= range.high)) continue;
    s.x.push_back(e.t2);
    s.y.push_back(e.gap);
    const Interval ci95 = interval_of(e);
    s.y_intervals.push_back({std::max(ci95.low, range.low), std::min(ci95.high, range.high)});
  }
  return s;
}

Panel over_time(const ReportView& view) {
  Panel panel{is_play(view) ? "Loop by loop" : "Passage by passage",
              view.time_axis({view.time.front(), view.time.back()}),
              {is_play(view) ? "play at zero torque" : "estimate of $2β$",
               view.length_unit,
               event_range(view),
               {},
               {}},
              520.0};
  for (const Series& s :
       {passages(view, "$x_1$ rising", 1, true, Marker::kTriangleUp),
        passages(view, "$x_1$ falling", -1, true, Marker::kTriangleDown),
        passages(view, is_denied(view) ? "set aside: no gap" : "set aside", 0, false, Marker::kCross)})
    if (!s.x.empty()) panel.series.push_back(s);
  const Interval& ci = view.run.model_free->ci95;
  if (std::isfinite(ci.low)) panel.y_bands.push_back({ci, kBandShade, "95 % interval"});
  if (is_denied(view))
    panel.y_marks.push_back(
        {view.run.model_free->none_above(), model_free_style(), "a gap this wide would have shown"});
  if (std::isfinite(view.true_gap()))
    panel.y_marks.push_back({view.true_gap(), truth_style(), view.true_gap_name()});
  return panel;
}

bool has_passages(const ReportView& view) {
  return view.run.model_free && view.recording &&
         std::any_of(view.events.begin(), view.events.end(),
                     [](const GapEvent& e) { return std::isfinite(e.gap); });
}

std::string passages_reading(const ReportView& view) {
  std::vector<double> up, down;
  for (const GapEvent& e : view.accepted()) (e.direction > 0 ? up : down).push_back(e.gap);
  const std::size_t aside = view.events.size() - up.size() - down.size();
  std::string text = " Passages used: " + std::to_string(up.size()) + " rising";
  if (!up.empty()) text += " (median " + quantity(median(up), view.length_unit) + ")";
  text += ", " + std::to_string(down.size()) + " falling";
  if (!down.empty()) text += " (median " + quantity(median(down), view.length_unit) + ")";
  text += "; set aside: " + std::to_string(aside);
  const Interval range = event_range(view);
  const auto beyond = std::count_if(view.events.begin(), view.events.end(), [&](const GapEvent& e) {
    return std::isfinite(e.gap) && (e.gap < range.low || e.gap > range.high);
  });
  if (beyond > 0) text += ", " + std::to_string(beyond) + " of them beyond the scale";
  return text + ".";
}

}  // namespace

FigureData estimates(const ReportView& view) {
  FigureData figure{"estimates.png", "Estimates of the gap"};
  Panel panel = side_by_side(view);
  if (!panel.series.empty()) figure.panels.push_back(panel);
  if (has_passages(view)) figure.panels.push_back(over_time(view));
  if (figure.panels.empty()) return missing_figure(figure, "there is no estimate of a gap");
  figure.reading = accuracy(view.run);
  if (figure.reading.empty()) figure.reading = without_estimate(view.run);
  if (has_passages(view)) figure.reading += passages_reading(view);
  return figure;
}

}  // namespace gapscope::internal::report
