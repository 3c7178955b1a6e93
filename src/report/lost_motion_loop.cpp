#include <fmt/format.h>

#include <cmath>

#include "report/drive_signal.h"
#include "report/figures.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// Where x1 stands as the input passes zero on its way up or down: a loop with rising x1 starts on the branch
/// of the rising input.
std::vector<double> positions_at_zero(const ReportView& view, bool rising) {
  std::vector<double> positions;
  for (const GapEvent& e : view.accepted())
    positions.push_back((e.direction > 0) == rising ? e.x1_t1 : e.x1_t2);
  return positions;
}

}  // namespace

FigureData lost_motion_loop(const ReportView& view) {
  FigureData figure;
  figure.file = "lost_motion_loop.png";
  figure.title = "Displacement against input";
  if (!view.recording || !view.run.model_free || view.run.model_free->method != GapMethod::kLostMotion) {
    figure.missing = "the gap was not looked for by the lost-motion method";
    figure.expected = false;
    return figure;
  }
  const DriveSignal drive = drive_signal(view);
  Panel panel;
  panel.x = drive.axis;
  panel.y = {"motor $x_1$", view.length_unit, {}, {}, {}};
  panel.height = 760.0;
  Series loop;
  loop.style = measured_style();
  loop.style.width = 3.0;
  loop.x = without_noise(view, drive.values);
  loop.y = view.recording->x1;
  panel.x_marks.push_back({0.0, guide_style(), ""});
  const double up = median(positions_at_zero(view, true)), down = median(positions_at_zero(view, false));
  const double estimate = view.run.model_free->gap;
  figure.reading = "There is no one play at zero input: the loops disagree, or are hysteresis alone.";
  if (std::isfinite(up) && std::isfinite(down) && std::isfinite(estimate)) {
    const std::string play = quantity(std::abs(down - up), view.length_unit);
    panel.dimensions.push_back({{std::min(up, down), std::max(up, down)}, "play " + play});
    for (const double y : {up, down}) panel.y_marks.push_back({y, guide_style(), ""});
    figure.reading = fmt::format("At zero {} the two branches lie {} apart (medians); the estimate is {}.",
                                 drive.name, play, quantity(estimate, view.length_unit));
  }
  panel.series.push_back(loop);
  figure.panels.push_back(panel);
  return figure;
}

}  // namespace gapscope::internal::report
