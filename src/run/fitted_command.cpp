#include "run/fitted_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gapscope/base/errors.h"

namespace gapscope::internal::run {
namespace {

/// "controller.position.gain 1.15 [1.13, 1.17] unit of u/rad"
std::string told(const FittedParameter& p) {
  const std::string interval =
      p.identifiable ? fmt::format(" [{:.4g}, {:.4g}]", p.ci95.low, p.ci95.high) : " (not determined)";
  return fmt::format("{} {:.4g}{} {}", p.key, p.value, interval, p.unit);
}

}  // namespace

void command_anew(const DriveController& controller, std::vector<Recording>& recordings) {
  for (Recording& r : recordings)
    if (r.command) r.u = commanded_input(controller, *r.command, r.command_first, r.size());
}

ReferenceModel settled_model(const Configuration& c) {
  ReferenceModel model = c.reference_model();
  model.controller.reset();
  return model;
}

std::string settle_controller(const Configuration& c, std::vector<Recording>& fitted,
                              std::vector<Recording>& held_out) {
  if (!c.controller || !c.controller->estimates()) return {};
  std::vector<MotorTrace> traces;
  for (const Recording& r : fitted) traces.push_back(r.motor_trace());
  const FitSummary found = fit(traces, c.reference_model(), c.fit);
  if (found.status == FitStatus::kFailed)
    throw ConfigError(
        c.file,
        "has a controller to estimate, but the fit of the model as it is found no numbers for it, "
        "expected controller: with numbers, or a model nearer to the drive");
  const DriveController controller = fitted_controller(*c.controller, found);
  command_anew(controller, fitted);
  command_anew(controller, held_out);
  std::vector<std::string> numbers;
  for (const FittedParameter& p : found.parameters)
    if (p.estimated && p.key.starts_with("controller.")) numbers.push_back(told(p));
  return fmt::format(
      "the controller that the diagnosis takes as known is that of a fit of the model as it is{}: {}",
      found.converged() ? "" : ", which has not converged", fmt::join(numbers, ", "));
}

}  // namespace gapscope::internal::run
