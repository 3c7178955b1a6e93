#include <fmt/format.h>

#include "report/figures.h"
#include "report/signals.h"
#include "report/view_signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

Panel over_time(const ReportView& view, const std::string& title, const Axis& y, const LineStyle& style,
                const std::vector<double>& values) {
  Panel panel{title, view.time_axis(view.window), y, 330.0, false};
  panel.series.push_back(view.over_time("", style, values, view.window));
  return panel;
}

Panel state_and_error(const ReportView& view) {
  Panel panel;
  panel.x = view.time_axis(view.window);
  panel.y = {"displacement", view.length_unit};
  panel.height = 480.0;
  panel.title = view.state.empty() ? view.error_title() : view.state_title();
  double target = kNaN;
  if (!view.state.empty()) {
    const bool fitted = view.source == StateSource::kFitted;
    panel.series.push_back(view.over_time(view.state_name(), fitted ? reference_style() : measured_style(),
                                          view.state, view.window));
    target = 0.5 * peak_to_peak(panel.series.back().y);
    if (view.error) panel.title = view.error_title(panel.title + " and $e_x$");
  }
  if (view.error)
    panel.series.push_back(
        view.state.empty() ? view.over_time("error $e_x$", model_free_style(), view.error->error, view.window)
                           : scaled_error(view, view.window, target));
  if (panel.series.size() == 1) {  // one line needs no legend, the axis names it
    panel.y.name = panel.series[0].label;
    panel.series[0].label.clear();
  }
  return panel;
}

std::string reading(const ReportView& view) {
  const double travel = peak_to_peak(view.recording->position());
  std::string text = (view.reads_load() ? "x2 travels " : "x1 travels ") +
                     quantity(travel, view.length_unit) + " from end to end";
  if (view.run.model_free && std::isfinite(view.run.model_free->gap))
    text += ", " + plain_number(travel / view.run.model_free->gap) + " times the gap found";
  if (!view.state.empty())
    text += fmt::format("; the {} backlash state x1 − x2 spans {}",
                        view.source == StateSource::kFitted ? "fitted" : "recorded",
                        quantity(peak_to_peak(view.state), view.length_unit));
  if (view.error)
    text += "; e_x is at most " + quantity(largest_magnitude(view.error->error), view.length_unit);
  if (view.state_offset != 0.0)
    text += " (x1 − x2 drawn around its middle: the two encoders have no common zero)";
  return text + ".";
}

}  // namespace

FigureData fig2_input_and_displacement(const ReportView& view) {
  FigureData figure{"fig2_input_and_displacement.png", view.state.empty()
                                                           ? "Input, displacement and estimation error"
                                                           : "Input, displacement and backlash state"};
  if (!view.recording) return missing_figure(figure, "no recording is stored");
  figure.panels.push_back(
      over_time(view, "Input", {"input $u$", input_unit(view.run)}, input_style(), view.recording->u));
  figure.panels.push_back(over_time(view, view.reads_load() ? "Load displacement" : "Motor displacement",
                                    {view.position_name(), view.length_unit}, measured_style(),
                                    view.recording->position()));
  if (!view.state.empty() || view.error) figure.panels.push_back(state_and_error(view));
  figure.panels.back().x_labels = true;
  figure.reading = reading(view);
  return figure;
}

}  // namespace gapscope::internal::report
