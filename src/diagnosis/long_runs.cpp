#include "diagnosis/long_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/normal.h"
#include "gapscope/simulation/closed_loop.h"
#include "reference/observer.h"

namespace gapscope::internal::diagnosis {
namespace {

/// What a model misses.
struct Missed {
  std::array<std::vector<double>, kLongRuns.parts.size()>
      runs;                    ///< restarted for each of so many parts [rad]
  std::vector<double> torque;  ///< [N m]
};

/// Of one recording, behind what is there. @returns whether all of it stayed within the numbers
bool follow(const PlantModel<double>& plant, const DriveState<double>& start, const MotorTrace& trace,
            bool runs_freely, Missed& missed) {
  const reference::ObserverGains gains(kMeasure.fast_hz, trace);
  std::vector<DriveStepper<double>> runs(kLongRuns.parts.size(), reference::stepper_for(plant, trace));
  bool healthy = true;
  const auto run_on = [&](std::size_t k, std::size_t i, const DriveStepper<double>& observer) {
    const std::size_t length = (trace.size() + kLongRuns.parts[k] - 1) / kLongRuns.parts[k];
    if (i % length == 0) runs[k] = observer;
    missed.runs[k].push_back(trace.x1[i] - runs[k].measured());
    reference::play_step(runs[k], trace, i);
    healthy = healthy && runs[k].healthy();
  };
  const bool observed = reference::roll_out(
      plant, start, trace, gains, [&](std::size_t i, const DriveStepper<double>& observer) {
        const double motor = plant.drive.motor_inertia * gains.at(i).speed / gains.interval(i);
        missed.torque.push_back(motor * (trace.x1[i] - observer.measured()));
        for (std::size_t k = 0; k < runs.size() && runs_freely && healthy; ++k) run_on(k, i, observer);
      });
  return observed && healthy;
}

/// The same of runs with the controller in the loop.
bool follow_in_loop(const PlantModel<double>& plant, const DriveState<double>& start, const MotorTrace& trace,
                    const DriveController& controller, Missed& missed) {
  DriveStepper<double> stepper = reference::stepper_for(plant, trace);
  const std::vector<double> x = positions_under_controller(
      plant, controller, trace, reference::behind_the_sensor(plant, stepper, start));
  for (std::size_t i = 0; i < x.size(); ++i) missed.runs.front().push_back(trace.x1[i] - x[i]);
  return !x.empty();
}

/// Whether an effect is a line over the position, of which a run that drifts soon loses the phase.
bool is_fine_line(const ModelEffect& effect, double travel) {
  const int period = effect.entry->period_at();
  return period >= 0 &&
         2.0 * kPi / effect.parameters[static_cast<std::size_t>(period)].value < kLongRuns.fine * travel;
}

/// By effect of the model.
std::vector<bool> fine_lines_of(const Study& study, const ReferenceModel& model) {
  double travel = 0.0;
  for (const MotorTrace& t : study.train) {
    const auto [low, high] = std::ranges::minmax_element(t.x1);
    travel = std::max(travel, *high - *low);
  }
  std::vector<bool> fine;
  for (const ModelEffect& e : model.effects) fine.push_back(is_fine_line(e, travel));
  return fine;
}

std::vector<reference::ParameterId> numbers_of(const std::vector<bool>& effects,
                                               const ReferenceModel& model) {
  std::vector<reference::ParameterId> numbers;
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (std::size_t i = 0; effects[e] && i < model.effects[e].entry->parameters.size(); ++i)
      numbers.push_back({static_cast<int>(e), static_cast<int>(i)});
  return numbers;
}

/// Errors of the numbers after a fit for runs, in which what they moved by counts as one more; and those that
/// moved out of their interval.
void tell_moved(const reference::ModelFit& fit, const reference::FitPoint& from, const ReferenceModel& was,
                const reference::FitPoint& to, FittedModel& moved) {
  ReferenceModel before = was;
  const reference::StandardErrors by_torque = fit.standard_errors(from);
  moved.errors = fit.standard_errors(to);
  for (std::size_t i = 0; i < moved.errors->numbers.size(); ++i) {
    auto& [id, error] = moved.errors->numbers[i];
    const double old = setting_of(before, id).value, now = setting_of(moved.model, id).value;
    error = std::hypot(error, now - old);
    const double beyond = normal_interval(0.0, by_torque.numbers[i].second).high;
    if (std::abs(now - old) > beyond) moved.disagreements.push_back({id, old, now});
  }
}

}  // namespace

FittedModel fitted_for_runs(const Study& study, const FittedModel& model) {
  if (model.model.structure.has_load || model.model.controller) return model;
  const bool in_loop = study.options.controller && std::ranges::all_of(study.train, [](const MotorTrace& t) {
                         return t.command != nullptr;
                       });
  const std::vector<bool> fine = fine_lines_of(study, model.model);
  const auto kinds = [&](const reference::ModelRun& run) -> std::vector<std::vector<double>> {
    Missed missed;
    for (std::size_t r = 0; r < study.train.size(); ++r) {
      const MotorTrace& trace = study.train[r];
      if (!follow(run.plant, run.starts[r], trace, !in_loop, missed)) return {};
      if (in_loop && !follow_in_loop(run.plant, run.starts[r], trace, *study.options.controller, missed))
        return {};
    }
    std::vector<std::vector<double>> all(1, std::move(missed.torque));
    for (std::vector<double>& errors : missed.runs)
      if (!errors.empty()) all.push_back(std::move(errors));
    return all;
  };
  const reference::ModelFit fit(study.train, model.model, study.options.fit, study.observer_hz);
  const reference::FitPoint from = fit.point_of(model.model, starts_on(study, model));
  const std::optional<reference::FitPoint> to =
      fit.lessen(from, kinds, numbers_of(fine, model.model), kLongRuns.iterations, study.options.threads);
  if (!to) return model;
  FittedModel moved = model;
  moved.model = fit.model_at(*to);
  moved.starts = to->starts;
  moved.balanced = false;
  tell_moved(fit, from, model.model, *to, moved);
  return moved;
}

ScoredModel settled(const Study& study, const ScoredModel& model) {
  if (!std::isfinite(model.fitted.mean_cost)) return model;
  const double hz = study.observer_hz;
  FitOptions options = study.options.fit;
  options.work = nullptr;  // none of a search, which has its limit
  const reference::ModelFit fit(study.train, model.fitted.model, options, hz);
  const reference::FitPoint at = fit.point_of(model.fitted.model, starts_on(study, model.fitted));
  std::optional<reference::SettledFit> found = fit.settled(at, study.effort.settling);
  if (!found) return judge(model.entry, fitted_for_runs(study, model.fitted), study.held_out, hz);
  FittedModel fitted = fitted_at(fit, found->end);
  fitted.errors = std::move(found->errors);
  return judge(model.entry, std::move(fitted), study.held_out, hz);
}

}  // namespace gapscope::internal::diagnosis
