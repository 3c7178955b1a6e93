#include "run/fitted_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gapscope/base/errors.h"

namespace gapscope::internal::run {
namespace {

/// "controller.position.gain 1.15 [1.13, 1.17] unit of u/rad"
std::string told(const FittedParameter& p) {
  const std::string interval =
      p.identifiable ? fmt::format(" [{:.4g}, {:.4g}]", p.ci95.low, p.ci95.high) : " (not determined)";
  return fmt::format("{} {:.4g}{} {}", p.key, p.value, interval, p.unit);
}

bool is_of_controller(const FittedParameter& p) { return p.estimated && p.key.starts_with("controller."); }

std::string numbers_told(const FitSummary& found) {
  std::vector<std::string> numbers;
  for (const FittedParameter& p : found.parameters)
    if (is_of_controller(p)) numbers.push_back(told(p));
  return fmt::format("{}", fmt::join(numbers, ", "));
}

bool is_determined(const FitSummary& found) {
  return std::none_of(found.parameters.begin(), found.parameters.end(),
                      [](const FittedParameter& p) { return is_of_controller(p) && !p.identifiable; });
}

/// What the fit says of the controller's numbers: with which others they change.
std::string confounded_with(const FitSummary& found, Coordinates coordinates) {
  std::string said;
  for (const Remark& warning : found.warnings)
    if (const std::string text = warning.text(coordinates); text.find("controller.") != std::string::npos)
      said += "; " + text;
  return said;
}

std::vector<MotorTrace> motor_traces(const std::vector<Recording>& recordings) {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return traces;
}

/// The controller with these values, to be estimated from there.
ControllerModel starting_at(ControllerModel model, DriveController found) {
  for (int i = 0; i < kControllerNumberCount; ++i)
    if (ParameterSetting& p = model.numbers[static_cast<std::size_t>(i)]; p.estimate)
      p.value = controller_number(found, i);
  return model;
}

}  // namespace

void command_anew(const DriveController& controller, std::vector<Recording>& recordings) {
  for (Recording& r : recordings)
    if (r.command) command_by(controller, r);
}

ReferenceModel diagnosed_model(const Configuration& c, const std::optional<ControllerModel>& sought) {
  ReferenceModel model = c.reference_model();
  model.controller = sought;
  return model;
}

SettledController settle_controller(const Configuration& c, std::vector<Recording>& fitted,
                                    std::vector<Recording>& held_out) {
  const bool commands = c.recording && !c.recording->reading.columns.reads_input();
  if (!commands || !c.recording->reading.controller) return {};
  if (!c.controller || !c.controller->estimates()) return {c.recording->reading.controller, {}, ""};
  const FitSummary found = fit(motor_traces(fitted), c.reference_model(), c.fit);
  if (found.status == FitStatus::kFailed)
    throw ConfigError(
        c.file,
        "has a controller to estimate, but the fit of the model as it is found no numbers for it, "
        "expected controller: with numbers, or a model nearer to the drive");
  const DriveController controller = fitted_controller(*c.controller, found);
  command_anew(controller, fitted);
  command_anew(controller, held_out);
  const std::string numbers =
      fmt::format("{}{}", numbers_told(found), found.converged() ? "" : " (the fit has not converged)");
  if (!is_determined(found))
    return {controller,
            {},
            "the recordings do not determine the controller that was to be estimated, and the diagnosis "
            "takes as known what a fit of the model as it is came to, all torques in proportion: " +
                numbers + confounded_with(found, c.coordinates)};
  return {controller, starting_at(*c.controller, controller),
          "the controller is estimated anew with each step of the diagnosis; the model as it is takes " +
              numbers};
}

std::string controller_found(const Configuration& c, const ReferenceModel& diagnosed,
                             const std::vector<Recording>& fitted) {
  if (!diagnosed.controller) return {};
  const FitSummary found = fit(motor_traces(fitted), diagnosed, c.fit);
  if (found.status == FitStatus::kFailed) return {};
  return "the controller with what the diagnosis has added: " + numbers_told(found) +
         (is_determined(found) ? "" : confounded_with(found, c.coordinates));
}

}  // namespace gapscope::internal::run
