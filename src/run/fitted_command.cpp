#include "run/fitted_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "base/text.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::run {
namespace {

/// Whether the model that a number is of stands: one that nothing establishes, or that is rejected, has no
/// intervals.
enum class Standing { kStands, kUnestablished };

/// "controller.position.gain 1.15 [1.13, 1.17] unit of u/rad"
std::string told(const FittedParameter& p, const FitSummary& of, Standing model) {
  const std::string interval = of.rejected()                       ? " (model rejected)"
                               : model == Standing::kUnestablished ? " (no interval: no model is established)"
                               : !of.converged()                   ? " (no interval: not converged)"
                               : p.identifiable ? fmt::format(" [{:.4g}, {:.4g}]", p.ci95.low, p.ci95.high)
                                                : " (not determined)";
  return fmt::format("{} {:.4g}{} {}", p.key, p.value, interval, p.unit);
}

bool is_of_controller(const FittedParameter& p) { return p.estimated && p.key.starts_with("controller."); }

std::string numbers_told(const FitSummary& found, Standing model) {
  std::vector<std::string> numbers;
  for (const FittedParameter& p : found.parameters)
    if (is_of_controller(p)) numbers.push_back(told(p, found, model));
  return fmt::format("{}", fmt::join(numbers, ", "));
}

bool is_determined(const FitSummary& found) {
  return std::none_of(found.parameters.begin(), found.parameters.end(),
                      [](const FittedParameter& p) { return is_of_controller(p) && !p.identifiable; });
}

/// "controller.position.gain 1.14": as fitted.yaml has the numbers that were estimated.
std::string numbers_written(const ControllerModel& model) {
  DriveController controller = model.at_start();
  std::vector<std::string> numbers;
  for (int i = 0; i < kControllerNumberCount; ++i)
    if (model.numbers[i].estimate)
      numbers.push_back(
          fmt::format("{} {:.4g}", kControllerNumbers[i].key, controller_number(controller, i)));
  return fmt::format("{}", fmt::join(numbers, ", "));
}

/// Whether a key of the controller is among what a remark names.
bool names_controller(const Remark& remark) {
  return std::ranges::any_of(remark.values(), [](const Remark::Value& value) {
    const auto* keys = std::get_if<std::string>(&value);
    return keys != nullptr && keys->find("controller.") != keys->npos;
  });
}

/// What the fit says of the controller's numbers: with which others they change.
std::string confounded_with(const FitSummary& found, Coordinates coordinates) {
  std::string said;
  for (const Remark& warning : found.warnings)
    if (names_controller(warning)) said += "; " + warning.text(coordinates);
  return said;
}

/// Whether a fit leaves more than the encoder does.
bool lacks_something(const FitSummary& found) {
  return found.why.code() == "leaves_unexplained" || found.why.code() == "above_floor";
}

/// The effect that comes nearest to what the diagnosis leaves; nullptr where none was asked for that.
const RankedEffect* nearest(const Diagnosis& d) {
  const bool more = !d.effects.empty();
  if (more && (d.steps.empty() || d.steps.back().accepted)) return nullptr;
  const std::vector<RankedEffect>& ranking = more ? d.steps.back().ranking : d.ranking;
  return !ranking.empty() && ranking.front().rel > 0.0 ? &ranking.front() : nullptr;
}

/// The model with an effect as the diagnosis has fitted it, from where it is estimated.
ReferenceModel with_ranked(ReferenceModel model, const RankedEffect& ranked) {
  ModelEffect effect{find_effect(ranked.effect), {}};
  for (std::size_t i = 0; i < ranked.parameters.size(); ++i) {
    const bool count = std::string_view(ranked.parameters[i].key) == "periods_per_turn";
    effect.parameters[i] = count ? ParameterSetting::known(ranked.parameters[i].value)
                                 : ParameterSetting::sought(ranked.parameters[i].value);
  }
  std::erase_if(model.effects,
                [&](const ModelEffect& e) { return e.entry == contained_effect(*effect.entry); });
  model.effects.push_back(effect);
  return model;
}

/// What the model lacks yet moves the controller's numbers: as much as the effect does that comes nearest.
std::string confounded_with_what_is_missing(const Configuration& c, const Diagnosis& d,
                                            const std::vector<MotorTrace>& fitted) {
  const std::string said =
      "; the model still lacks something, and the controller's numbers are confounded with that";
  const RankedEffect* effect = nearest(d);
  if (effect == nullptr) return said;
  const FitSummary found = fit(fitted, with_ranked(d.fitted, *effect), c.fit);
  if (found.status == FitStatus::kFailed) return said;
  return said + fmt::format(": with {}, which comes nearest to it and is not established, they are {}",
                            readable(effect->effect), numbers_told(found, Standing::kUnestablished));
}

std::vector<MotorTrace> motor_traces(const std::vector<Recording>& recordings) {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return traces;
}

/// The controller with these values, to be estimated from there.
ControllerModel starting_at(ControllerModel model, DriveController found) {
  for (int i = 0; i < kControllerNumberCount; ++i)
    if (ParameterSetting& p = model.numbers[i]; p.estimate) p.value = controller_number(found, i);
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
  if (!is_determined(found))
    return {controller,
            {},
            "the recordings do not determine the controller that was to be estimated, and the diagnosis "
            "holds what a fit of the model as it is came to, all torques in proportion: " +
                numbers_told(found, Standing::kStands) +
                (found.converged() ? "" : " (the fit has not converged)") +
                confounded_with(found, c.coordinates)};
  return {controller, starting_at(*c.controller, controller),
          ""};  // told of the last fit, with each step anew
}

std::string controller_found(const Configuration& c, const Diagnosis& d,
                             const std::vector<Recording>& recordings) {
  if (!d.fitted.controller) return {};
  const std::vector<MotorTrace> fitted = motor_traces(recordings);
  const FitSummary found = fit(fitted, d.fitted, c.fit);
  if (found.status == FitStatus::kFailed) return {};
  const std::string when = d.effects.empty() ? "the controller, fitted with the model as it is: "
                                             : "the controller, fitted with what the diagnosis has added: ";
  const bool unknown = d.verdict == DiagnosisVerdict::kUnknown;
  return when + numbers_told(found, unknown ? Standing::kUnestablished : Standing::kStands) +
         "; these are of a last fit" + (unknown ? "" : ", which has their intervals") +
         ", and `fitted.yaml` has " + numbers_written(*d.fitted.controller) + " of the search" +
         (is_determined(found) ? "" : confounded_with(found, c.coordinates)) +
         (lacks_something(found) ? confounded_with_what_is_missing(c, d, fitted) : "");
}

}  // namespace gapscope::internal::run
