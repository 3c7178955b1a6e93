#include "report/view_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
DriveSignal drive_signal(const ReportView& view) {
  const FittedParameter* constant = parameter(view.run, "torque_constant");
  if (constant == nullptr || !std::isfinite(constant->value))
    return {view.recording->u, {"input $u$", input_unit(view.run)}, "input"};
  const std::string name = view.run.coordinates.torque_word();
  return {times(view.recording->u, constant->value),
          {name + " $K_m u$", torque_unit(view.run), {}, {}, {}, {}, torque_note(view.run.input)},
          name};
}

std::vector<double> without_noise(const ReportView& view, const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(std::abs(values[i] - values[i - 1]));
  const bool noisy = median(steps) > 0.005 * peak_to_peak(values);
  if (!noisy || !std::isfinite(view.half_period)) return values;
  return moving_mean(values, static_cast<std::size_t>(0.005 * view.half_period / view.recording->dt) + 1);
}

double error_factor(const ReportView& view, const Interval& interval, double target) {
  const double peak = largest_magnitude(view.part(view.error->error, interval));
  const double own = view.run.model_free->scale;
  const bool fits = own * peak > 0.2 * target && own * peak < 1.3 * target;
  return fits ? own : round_factor(peak, target);
}

Series scaled_error(const ReportView& view, const Interval& interval, double target) {
  const double factor = error_factor(view, interval, target);
  const std::string label = factor == 1.0 ? "$e_x$" : fmt::format("${:g} × e_x$", factor);
  LineStyle style = model_free_style();
  style.width = 3.5;  // it may chatter
  Series series = view.over_time(label, style, view.error->error, interval);
  series.y = times(series.y, factor);
  return series;
}

}  // namespace gapscope::internal::report
