#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.h"
#include "report/view_signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr double kShownWay = 2.5;  ///< gaps behind a reversal

std::size_t sample_at(const Recording& r, double time) {
  const double i = std::round((time - r.start) / r.dt);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(r.position().size() - 1)));
}

/// What drives the motor along, over the way since a turn.
void add_reversal(const ReportView& view, const DriveSignal& drive, const GapEvent& e, double most,
                  Series& s) {
  const auto& x = view.recording->position();
  for (std::size_t i = sample_at(*view.recording, e.t1); i < x.size(); ++i) {
    const double way = e.direction * (x[i] - e.x1_t1);
    if (way > most) break;
    s.x.push_back(way);
    s.y.push_back(e.direction * drive.values[i]);
  }
  s.x.push_back(kNaN);
  s.y.push_back(kNaN);
}

}  // namespace

FigureData reversal_shelf(const ReportView& view) {
  FigureData figure{"reversal_shelf.png", "Input behind the reversals"};
  if (!view.recording || !view.run.model_free || view.run.model_free->method != GapMethod::kReversal ||
      view.run.model_free->verdict != GapVerdict::kBacklash)
    return missing_figure(figure, "the gap was not read behind slow reversals", false);
  const GapEstimate& g = *view.run.model_free;
  const DriveSignal drive = drive_signal(view);
  Series rising, falling;
  rising.label = "rising $x_1$", rising.style = {kBlue, 3.0, {}};
  falling.label = "falling $x_1$", falling.style = {Colour{230, 159, 0}, 3.0, {12, 8}};
  for (const GapEvent& e : g.events)
    if (e.file == view.recording->file)
      add_reversal(view, drive, e, kShownWay * g.gap, e.direction > 0 ? rising : falling);
  Panel panel;
  panel.x = {"way of $x_1$ since it turned round", view.length_unit};
  panel.y = drive.axis;
  panel.y.name += ", along the motion";
  panel.height = 760.0;
  panel.series = {rising, falling};
  panel.x_bands.push_back({g.ci95, Colour{220, 220, 220}, "gap, 95 %"});
  panel.x_marks.push_back({g.gap, guide_style(), "gap " + quantity(g.gap, view.length_unit)});
  figure.reading = fmt::format(
      "Behind a reversal the motor moves alone, against its own friction, for {}; then it pushes the load.",
      with_interval(g.gap, g.ci95, view.length_unit));
  figure.panels.push_back(panel);
  return figure;
}

}  // namespace gapscope::internal::report
