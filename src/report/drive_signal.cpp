#include "report/drive_signal.h"

#include <algorithm>
#include <cmath>

#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {

DriveSignal drive_signal(const ReportView& view) {
  const FittedParameter* constant = parameter(view.run, "torque_constant");
  if (constant == nullptr || !std::isfinite(constant->value))
    return {view.recording->u, {"input $u$", input_unit(view.run), {}, {}, {}}, "input"};
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

}  // namespace gapscope::internal::report
