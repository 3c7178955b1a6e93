#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal {
namespace {

/// The motor torque where the torque constant is known, else the input itself.
struct Drive {
  std::vector<double> values;
  Axis axis;
  std::string name;
};

Drive drive_of(const ReportView& view) {
  const FittedParameter* constant = parameter(view.run, "torque_constant");
  if (constant == nullptr || !std::isfinite(constant->value))
    return {view.recording->u, {"input $u$", "", {}, {}, {}}, "input"};
  const std::string name = view.run.rotation ? "torque" : "force";
  return {scaled(view.recording->u, constant->value),
          {name + " $K_m u$", torque_unit(view.run), {}, {}, {}},
          name};
}

std::vector<double> zero_crossings(const ReportView& view, const std::vector<double>& drive) {
  std::vector<double> times;
  for (const std::size_t i : middle_crossings(drive)) {
    std::size_t k = i;  // back from the end of the hysteresis to the middle itself
    const double middle = robust_middle(drive);
    while (k > 0 && (drive[k - 1] > middle) == (drive[i] > middle)) --k;
    times.push_back(view.time[k]);
  }
  return times;
}

Panel over_time(const ReportView& view, const std::string& title, const Series& series, const Axis& axis,
                const std::vector<double>& zeros) {
  Panel panel;
  panel.title = title;
  panel.x = view.time_axis(view.window);
  panel.y = axis;
  panel.height = 400.0;
  panel.series = {series};
  for (const double t : zeros)
    if (t > view.window.low && t < view.window.high) panel.x_marks.push_back({t, guide_style(), ""});
  return panel;
}

Panel loop(const ReportView& view, const Drive& drive, const LineStyle& style) {
  Panel panel;
  panel.title = "One against the other";
  panel.x = drive.axis;
  panel.y = {view.state_name(), view.length_unit, {}, {}, {}};
  panel.height = 470.0;
  Series s;
  s.style = style;
  s.style.dashes.clear();  // a loop run through many times fills its dashes
  s.style.width = 3.0;
  s.x = view.over_time("", {}, drive.values, view.window).y;
  s.y = view.over_time("", {}, view.state, view.window).y;
  panel.series.push_back(s);
  return panel;
}

std::string reading(const ReportView& view, const Drive& drive, const std::vector<double>& zeros) {
  std::vector<double> lags;
  for (const GapEvent& e : view.accepted()) {
    double lag = kNaN;
    for (const double t : zeros)
      if (t <= e.t2) lag = e.t2 - t;
    if (std::isfinite(lag)) lags.push_back(lag);
  }
  std::string text = fmt::format(
      "x1 − x2 ({}) goes from {} to {} as the {} swings by {}",
      view.source == StateSource::kFitted ? "of the fitted model, x2 was not recorded" : "recorded",
      quantity(*std::min_element(view.state.begin(), view.state.end()), view.length_unit),
      quantity(*std::max_element(view.state.begin(), view.state.end()), view.length_unit), drive.name,
      quantity(peak_to_peak(drive.values), drive.axis.unit));
  if (!lags.empty())
    text += fmt::format("; the gap is closed {} (median) after the {} crosses its middle, dotted",
                        quantity(median(lags), "s"), drive.name);
  return text + ".";
}

}  // namespace

FigureData fig4_backlash_state_and_input(const ReportView& view) {
  FigureData figure;
  figure.file = "fig4_backlash_state_and_input.png";
  figure.title = "Backlash state and input";
  if (view.state.empty())
    return missing_figure(figure.file, figure.title,
                          "x2 was not recorded and no fitted model with a load stands in for it");
  const Drive drive = drive_of(view);
  const std::vector<double> zeros = zero_crossings(view, drive.values);
  const LineStyle style = view.source == StateSource::kFitted ? reference_style() : measured_style();
  const Axis state_axis{view.state_name(), view.length_unit, {}, {}, {}};
  figure.panels.push_back(over_time(
      view, "Input", view.over_time("", input_style(), drive.values, view.window), drive.axis, zeros));
  figure.panels.push_back(over_time(view, "Backlash state",
                                    view.over_time("", style, view.state, view.window), state_axis, zeros));
  figure.panels.front().x_labels = false;
  figure.panels.push_back(loop(view, drive, style));
  figure.reading = reading(view, drive, zeros);
  return figure;
}

}  // namespace gapscope::internal
