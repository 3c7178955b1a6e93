#include "report/fig6_one_period.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.h"
#include "report/true_passages.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// The accepted passage whose estimate is nearest to the median, the earliest of equals.
const GapEvent* typical(const std::vector<GapEvent>& events) {
  std::vector<double> gaps;
  for (const GapEvent& e : events) gaps.push_back(e.gap);
  const double middle = median(gaps);
  const GapEvent* best = nullptr;
  for (const GapEvent& e : events)
    if (e.t2 > e.t1 && std::isfinite(e.x1_t1) && std::isfinite(e.x1_t2) &&
        (best == nullptr || std::abs(e.gap - middle) < std::abs(best->gap - middle)))
      best = &e;
  return best;
}

/// Whether the verdict is that there is a gap; else nothing here is an estimate of it.
bool is_told(const ReportView& view) {
  return view.run.model_free && view.run.model_free->verdict == GapVerdict::kBacklash;
}

/// Is S5 itself the estimate of this passage, to within 1 %?
bool uncorrected(const GapEvent& e) {
  return std::abs(std::abs(e.x1_t2 - e.x1_t1) - e.gap) <= 0.01 * std::abs(e.gap);
}

Panel displacement_panel(const ReportView& view, const OnePassage& p) {
  Panel panel;
  panel.x = view.time_axis(p.window);
  panel.y = {"$x_1$", view.length_unit};
  panel.height = 520.0;
  panel.title = "Motor displacement";
  panel.x_labels = false;
  panel.series.push_back(view.over_time("", measured_style(), view.recording->position(), p.window));
  for (const double y : {p.event.x1_t1, p.event.x1_t2}) panel.y_marks.push_back({y, guide_style(), ""});
  const double s5 = std::abs(p.event.x1_t2 - p.event.x1_t1);
  const std::string name = is_told(view) && uncorrected(p.event) ? "$2\\hat{β}$" : "$|x_1(t_2) − x_1(t_1)|$";
  panel.dimensions.push_back(
      {{std::min(p.event.x1_t1, p.event.x1_t2), std::max(p.event.x1_t1, p.event.x1_t2)},
       name + " = " + quantity(s5, view.length_unit)});
  return panel;
}

Panel error_panel(const ReportView& view, const OnePassage& p) {
  Panel panel;
  panel.x = view.time_axis(p.window);
  panel.y = {"$e_x$", view.length_unit};
  panel.height = 400.0;
  panel.title = view.error_title();
  if (view.error) panel.series.push_back(view.over_time("", model_free_style(), view.error->error, p.window));
  return panel;
}

/// What the simulated plant did, in the lower panel, whose other marks have no names.
void mark_truth(const ReportView& view, const OnePassage& p, Panel& panel, bool named) {
  for (const TruePassage& passage : true_passages(view, p.window)) {
    panel.x_marks.push_back({passage.released, truth_style(), named ? kTrueRelease : ""});
    panel.x_marks.push_back({passage.impact, truth_style(), named ? kTrueImpact : ""});
  }
}

void mark_times(Panel& panel, const OnePassage& p, bool named) {
  if (p.converged >= p.window.low)
    panel.x_marks.push_back({p.converged, guide_style(), named ? "$t_c$" : ""});
  panel.x_marks.push_back({p.event.t1, begin_style(), named ? "$t_1$" : ""});
  panel.x_marks.push_back({p.event.t2, end_style(), named ? "$t_2$" : ""});
  panel.x_bands.push_back({{p.event.t1, p.event.t2}, kGapShade, ""});
}

std::string reading(const ReportView& view, const OnePassage& p) {
  const GapEvent& e = p.event;
  std::string text = fmt::format(
      "contact is lost at t1 = {:.4f} s and regained at t2 = {:.4f} s, {} later; x1 moves {}", e.t1, e.t2,
      quantity(e.t2 - e.t1, "s"), quantity(std::abs(e.x1_t2 - e.x1_t1), view.length_unit));
  if (!is_told(view))
    text += ", which is no estimate of a gap: the verdict is inconclusive";
  else if (!uncorrected(e))
    text += ", which the travel of the load turns into an estimate of " + quantity(e.gap, view.length_unit);
  text += std::isfinite(p.converged)
              ? fmt::format("; e_x had been near zero since t_c = {:.4f} s", p.converged)
              : "; e_x was not quiet just before t1, so t_c is not drawn";
  text += view.drawn_bound();
  for (const TruePassage& truth : true_passages(view, p.window))
    text += fmt::format("; in the simulation contact was lost at {:.4f} s and regained at {:.4f} s",
                        truth.released, truth.impact);
  return "Passage nearest to the median: " + text + ".";
}

}  // namespace

std::optional<OnePassage> typical_passage(const ReportView& view) {
  const std::vector<GapEvent> events = view.accepted();
  const GapEvent* event = view.recording ? typical(events) : nullptr;
  if (event == nullptr) return std::nullopt;
  OnePassage p;
  p.event = *event;
  p.converged = p.event.t_c;
  const double flight = p.event.t2 - p.event.t1;
  const bool near = p.event.t1 - p.converged < 6.0 * flight;  // false for NaN
  const double start = near ? std::min(p.converged, p.event.t1 - flight) : p.event.t1 - 2.0 * flight;
  p.window.low = std::max(view.time.front(), start - 0.5 * flight);
  p.window.high = std::min(view.time.back(), p.event.t2 + 1.2 * flight);
  return p;
}

FigureData fig6_one_period(const ReportView& view) {
  FigureData figure{"fig6_one_period.png", "One passage of the gap"};
  if (view.run.model_free && view.run.model_free->method == GapMethod::kLostMotion)
    return missing_figure(figure, "the lost-motion loop has no instants at which contact is lost or regained",
                          false);
  const std::optional<OnePassage> passage = typical_passage(view);
  if (!passage)
    return missing_figure(figure, view.run.model_free ? "no passage of the gap was accepted"
                                                      : "the model-free detector was not asked for");
  if (!is_told(view)) figure.title = "What looks like a passage of the gap";
  figure.panels = {displacement_panel(view, *passage), error_panel(view, *passage)};
  if (!view.error) {
    figure.panels.pop_back();
    figure.panels.front().x_labels = true;
  }
  for (Panel& panel : figure.panels) {
    if (view.error) mark_truth(view, *passage, panel, &panel == &figure.panels.back());
    mark_times(panel, *passage, &panel == &figure.panels.front());
  }
  figure.reading = reading(view, *passage);
  return figure;
}

}  // namespace gapscope::internal::report
