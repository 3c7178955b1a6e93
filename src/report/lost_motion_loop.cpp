#include <fmt/format.h>

#include <cmath>

#include "report/drive_signal.h"
#include "report/figures.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal {
namespace {

/// Where x1 stands as the input passes zero on its way up or down.
std::vector<double> positions_at_zero(const ReportView& view, const std::vector<double>& drive, bool rising) {
  std::vector<double> positions;
  for (std::size_t i = 1; i < drive.size(); ++i)
    if (rising ? drive[i - 1] < 0.0 && drive[i] >= 0.0 : drive[i - 1] > 0.0 && drive[i] <= 0.0)
      positions.push_back(view.recording->x1[i]);
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
  const double up = median(positions_at_zero(view, loop.x, true));
  const double down = median(positions_at_zero(view, loop.x, false));
  figure.reading = "The branches of the loop have no common zero of the input.";
  if (std::isfinite(up) && std::isfinite(down)) {
    const std::string play = quantity(std::abs(down - up), view.length_unit);
    panel.dimensions.push_back({{std::min(up, down), std::max(up, down)}, "play " + play});
    for (const double y : {up, down}) panel.y_marks.push_back({y, guide_style(), ""});
    figure.reading = fmt::format("At zero {} the two branches lie {} apart (medians); the estimate is {}.",
                                 drive.name, play, quantity(view.run.model_free->gap, view.length_unit));
  }
  panel.series.push_back(loop);
  figure.panels.push_back(panel);
  return figure;
}

}  // namespace gapscope::internal
