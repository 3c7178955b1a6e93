#include <fmt/format.h>

#include <cmath>

#include "report/error_scale.h"
#include "report/figures.h"
#include "report/signals.h"
#include "report/ticks.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// What is taken off x1 so that it can share an axis with e_x, a round number; 0 where zero is within its
/// travel.
double offset_of(const std::vector<double>& x1) {
  const double middle = robust_middle(x1), travel = peak_to_peak(x1);
  if (std::abs(middle) < 0.5 * travel) return 0.0;
  const double step = round_ticks(0.0, travel, 4).step;
  return step > 0.0 ? step * std::round(middle / step) : 0.0;
}

Series at_events(const ReportView& view, const std::string& label, Marker marker, bool first, double offset) {
  Series s;
  s.label = label;
  s.style = {kVermillion, 4.0, {}};
  s.marker = marker;
  s.joined = false;
  for (const GapEvent& e : view.accepted()) {
    const double t = first ? e.t1 : e.t2;
    if (!(t >= view.window.low && t <= view.window.high)) continue;
    s.x.push_back(t);
    s.y.push_back((first ? e.x1_t1 : e.x1_t2) - offset);
  }
  return s;
}

/// The bound of the differentiator that left the error trace.
std::string at_bound(const ReportView& view) {
  const GapEstimate& g = *view.run.model_free;
  const double bound = std::isfinite(g.bound_t1) ? g.bound_t1 : g.bound;
  if (!std::isfinite(bound)) return "";
  return " (L = " + quantity(bound, view.length_unit + "/s²") + ")";
}

std::string reading(const ReportView& view, double offset) {
  const std::size_t used = view.accepted().size();
  std::vector<double> magnitudes;
  for (const double e : view.error->error) magnitudes.push_back(std::abs(e));
  std::string text =
      fmt::format("e_x{} peaks at {}, {} times its median size; {} of the gap used, {} set aside",
                  at_bound(view), quantity(largest_magnitude(view.error->error), view.length_unit),
                  plain_number(largest_magnitude(view.error->error) / median(magnitudes)),
                  counted(used, "passage"), std::to_string(view.events.size() - used));
  if (!view.whole)
    text += fmt::format("; drawn: {} to {} of {}", quantity(view.window.low, "s"),
                        quantity(view.window.high, "s"), quantity(view.recording->duration(), "s"));
  if (offset != 0.0) text += "; x1 is drawn less " + quantity(offset, view.length_unit);
  return text + ".";
}

}  // namespace

FigureData fig5_displacement_and_error(const ReportView& view) {
  FigureData figure;
  figure.file = "fig5_displacement_and_error.png";
  figure.title = "Displacement and estimation error";
  if (!view.recording || !view.error)
    return missing_figure(figure.file, figure.title,
                          view.run.model_free ? "the detector left no error trace of the recording"
                                              : "the model-free detector was not asked for");
  const double offset = offset_of(view.recording->position());
  std::vector<double> x1 = view.recording->position();
  for (double& x : x1) x -= offset;
  Panel panel;
  panel.x = view.time_axis(view.window);
  panel.y = {"displacement", view.length_unit, {}, {}, {}};
  panel.height = 620.0;
  const std::string name =
      offset == 0.0 ? "$x_1$" : fmt::format("$x_1$ less {}", quantity(offset, view.length_unit));
  panel.series.push_back(view.over_time(name, measured_style(), x1, view.window));
  panel.series.push_back(scaled_error(view, view.window, 0.5 * peak_to_peak(x1)));
  for (const Series& s : {at_events(view, "contact lost, $t_1$", Marker::kCircle, true, offset),
                          at_events(view, "regained, $t_2$", Marker::kDisc, false, offset)})
    if (!s.x.empty()) panel.series.push_back(s);
  figure.panels.push_back(panel);
  figure.reading = reading(view, offset);
  return figure;
}

}  // namespace gapscope::internal::report
