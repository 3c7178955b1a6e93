#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.h"
#include "report/signals.h"
#include "report/view_signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// Where the input turns: its passages through zero, or through its middle where it does not change sign.
struct Turns {
  std::vector<double> times;  ///< [s]
  const char* level = "zero";
};

Turns turns_of(const ReportView& view, const std::vector<double>& drive) {
  Turns turns;
  double level = robust_middle(drive);
  if (std::abs(level) < 0.1 * peak_to_peak(drive))
    level = 0.0;
  else
    turns.level = "its middle";
  for (const std::size_t i : middle_crossings(drive)) {
    std::size_t k = i;  // back from the end of the hysteresis
    while (k > 0 && (drive[k - 1] > level) == (drive[i] > level)) --k;
    if (k == 0) continue;
    const double part = (level - drive[k - 1]) / (drive[k] - drive[k - 1]);
    turns.times.push_back(view.time[k - 1] + part * view.recording->dt);
  }
  return turns;
}

Panel over_time(const ReportView& view, const std::string& title, const Series& series, const Axis& axis,
                const std::vector<double>& zeros) {
  Panel panel{title, view.time_axis(view.window), axis, 400.0};
  panel.series = {series};
  for (const double t : zeros)
    if (t > view.window.low && t < view.window.high) panel.x_marks.push_back({t, guide_style(), ""});
  return panel;
}

Panel loop(const ReportView& view, const DriveSignal& drive, const LineStyle& style) {
  Panel panel{view.state_title() + " over input", drive.axis, {view.state_name(), view.length_unit}, 470.0};
  Series s;
  s.style = style;
  s.style.dashes.clear();  // a loop run through many times fills its dashes
  s.style.width = 3.0;
  const std::vector<double> smooth = without_noise(view, drive.values);
  const auto x = view.part(smooth, view.window), y = view.part(view.state, view.window);
  s.x.assign(x.begin(), x.end()), s.y.assign(y.begin(), y.end());
  panel.series.push_back(s);
  return panel;
}

std::string reading(const ReportView& view, const DriveSignal& drive, const Turns& turns) {
  std::vector<double> lags;
  for (const GapEvent& e : view.accepted()) {
    double lag = kNaN;
    for (const double t : turns.times)
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
    text += fmt::format("; the gap is closed {} (median) after the {} passes {}, dotted",
                        quantity(median(lags), "s"), drive.name, turns.level);
  return text + ".";
}

}  // namespace

FigureData fig4_backlash_state_and_input(const ReportView& view) {
  FigureData figure{"fig4_backlash_state_and_input.png", "Backlash state and input"};
  if (view.state.empty())
    return missing_figure(figure,
                          "x2 was not recorded, and there is no fitted model with a load in its place");
  const DriveSignal drive = drive_signal(view);
  const Turns turns = turns_of(view, drive.values);
  const LineStyle style = view.source == StateSource::kFitted ? reference_style() : measured_style();
  const Axis state_axis{view.state_name(), view.length_unit};
  figure.panels.push_back(over_time(
      view, "Input", view.over_time("", input_style(), drive.values, view.window), drive.axis, turns.times));
  figure.panels.push_back(over_time(
      view, view.state_title(), view.over_time("", style, view.state, view.window), state_axis, turns.times));
  figure.panels.front().x_labels = false;
  figure.panels.push_back(loop(view, drive, style));
  figure.reading = reading(view, drive, turns);
  return figure;
}

}  // namespace gapscope::internal::report
