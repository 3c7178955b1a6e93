#include <cmath>

#include "report/figures.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

Panel map(const ReportView& view, const std::string& title, const std::vector<double>& y, const Axis& axis) {
  Panel panel{title, {"motor $x_1$", view.length_unit}, axis, 470.0};
  Series s;
  s.style = measured_style();
  s.style.width = 3.0;
  const auto x_part = view.part(view.recording->x1, view.window), y_part = view.part(y, view.window);
  s.x.assign(x_part.begin(), x_part.end()), s.y.assign(y_part.begin(), y_part.end());
  panel.series.push_back(s);
  return panel;
}

/// The width of the map as a dimension, around the middle of the two flanks; it holds the gap and the
/// wind-up.
void mark_gap(const ReportView& view, Panel& panel) {
  const double gap = view.run.comparison ? view.run.comparison->map_width : kNaN;
  const double shown = std::isfinite(gap) ? gap : view.true_gap();
  if (!std::isfinite(shown)) return;
  const double middle = robust_middle(view.state);
  const Interval range{middle - shown / 2, middle + shown / 2};
  for (const double y : {range.low, range.high}) panel.y_marks.push_back({y, truth_style(), ""});
  const std::string what = std::isfinite(gap) ? "flank to flank " : "$2β$ = ";
  panel.dimensions.push_back({range, what + quantity(shown, view.length_unit)});
}

std::string width_of_map(const ReportView& view) {
  const double spread = quantile(view.state, 0.99) - quantile(view.state, 0.01);
  std::string text = "98 % of the samples of x1 − x2 lie within " + quantity(spread, view.length_unit);
  const double gap = view.run.comparison ? view.run.comparison->map_width : kNaN;
  if (std::isfinite(gap))
    text += "; from flank to flank the map is " + quantity(gap, view.length_unit) +
            " wide, the gap and the elastic wind-up of the loaded contact";
  else if (std::isfinite(view.true_gap()))
    text += "; the simulated gap is " + quantity(view.true_gap(), view.length_unit);
  else
    text += "; no gap was read off (that needs both estimators)";
  return text + ".";
}

}  // namespace

FigureData fig3_backlash_map(const ReportView& view) {
  FigureData figure{"fig3_backlash_map.png", "Backlash map of both encoders"};
  if (view.source != StateSource::kRecorded)
    return missing_figure(figure, view.reads_load() ? "the recording has no motor position x1"
                                                    : "the recording has no load position x2");
  figure.panels.push_back(map(view, "Load over motor", view.recording->x2, {"load $x_2$", view.length_unit}));
  figure.panels.push_back(map(view, "Backlash state", view.state, {"$x_1 − x_2$", view.length_unit}));
  figure.panels.front().x_labels = false;
  mark_gap(view, figure.panels.back());
  figure.reading = width_of_map(view);
  return figure;
}

}  // namespace gapscope::internal::report
