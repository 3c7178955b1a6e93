#include <fmt/format.h>

#include <cmath>

#include "report/figures.h"
#include "report/signals.h"
#include "report/true_passages.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

Series at_events(const ReportView& view, const std::string& label, Marker marker, bool first) {
  Series s;
  s.label = label;
  s.style = {kVermillion, 4.0, {}};
  s.marker = marker;
  s.joined = false;
  for (const GapEvent& e : view.accepted()) {
    const double t = first ? e.t1 : e.t2;
    if (!(t >= view.window.low && t <= view.window.high)) continue;
    s.x.push_back(t);
    s.y.push_back(first ? e.x1_t1 : e.x1_t2);
  }
  return s;
}

/// Impacts of which no begin was seen: none of them tells a gap, but e_x shows them.
Series at_lone_impacts(const ReportView& view) {
  Series s;
  s.label = "impact without $t_1$";
  s.style = {kVermillion, 4.0, {}};
  s.marker = Marker::kCross;
  s.joined = false;
  for (const GapEvent& e : view.events) {
    const bool lone = !e.accepted && std::isnan(e.t1) && std::isfinite(e.x1_t2);
    if (!lone || !(e.t2 >= view.window.low && e.t2 <= view.window.high)) continue;
    s.x.push_back(e.t2);
    s.y.push_back(e.x1_t2);
  }
  return s;
}

/// Releases or impacts of the simulated plant.
Series true_ones(const ReportView& view, bool release) {
  Series s;
  s.label = release ? kTrueRelease : kTrueImpact;
  s.style = {kGrey, 4.0, {}};
  s.marker = release ? Marker::kTriangleUp : Marker::kTriangleDown;
  s.joined = false;
  for (const TruePassage& p : true_passages(view, view.window)) {
    s.x.push_back(release ? p.released : p.impact);
    s.y.push_back(release ? p.x1_released : p.x1_impact);
  }
  return s;
}

std::string error_reading(const ReportView& view) {
  const std::size_t used = view.accepted().size();
  std::vector<double> magnitudes;
  for (const double e : view.error->error) magnitudes.push_back(std::abs(e));
  std::string text =
      fmt::format("e_x peaks at {}, {} times its median size; {} of the gap used, {} set aside{}",
                  quantity(largest_magnitude(view.error->error), view.length_unit),
                  plain_number(largest_magnitude(view.error->error) / median(magnitudes)),
                  counted(used, "passage"), std::to_string(view.events.size() - used), view.drawn_bound());
  if (!view.whole)
    text += fmt::format("; drawn: {} to {} of {}", quantity(view.window.low, "s"),
                        quantity(view.window.high, "s"), quantity(view.recording->duration(), "s"));
  return text + ".";
}

}  // namespace

FigureData fig5_displacement_and_error(const ReportView& view) {
  FigureData figure{"fig5_displacement_and_error.png", "Displacement and estimation error"};
  if (!view.recording || !view.error)
    return missing_figure(figure, view.run.model_free ? "the detector left no error trace of the recording"
                                                      : "the model-free detector was not asked for");
  Panel displacement{"Displacement",
                     view.time_axis(view.window),
                     {"displacement " + view.position_name(), view.length_unit},
                     420.0};
  displacement.series.push_back(
      view.over_time("", measured_style(), view.recording->position(), view.window));
  const bool by_one_bound = view.run.model_free && view.run.model_free->by_one_bound();
  for (const Series& s :
       {at_events(view, "contact lost, $t_1$", Marker::kCircle, true),
        at_events(view, "regained, $t_2$", Marker::kDisc, false),
        by_one_bound ? at_lone_impacts(view) : Series{}, true_ones(view, true), true_ones(view, false)})
    if (!s.x.empty()) displacement.series.push_back(s);
  Panel error{view.error_title(), displacement.x, {"error $e_x$", view.length_unit}, 360.0};
  LineStyle thin = model_free_style();
  thin.width = 3.5;  // it may chatter
  error.series.push_back(view.over_time("", thin, view.error->error, view.window));
  figure.panels = {displacement, error};
  figure.panels[0].x_labels = false;
  figure.reading = error_reading(view);
  return figure;
}

}  // namespace gapscope::internal::report
