#include "diagnosis/under_controller.h"

#include <algorithm>
#include <cmath>

#include "gapscope/simulation/closed_loop.h"
#include "reference/observer.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Of one recording.
struct SquaredError {
  double sum = kNaN, samples = 0.0;
  double rms() const { return std::sqrt(sum / samples); }
};

bool has_controller(const Study& study) {
  const auto commanded = [](const MotorTrace& t) { return t.command != nullptr; };
  const std::vector<MotorTrace>& held = study.held_out.traces;
  return (study.options.controller || study.sheet.controller) &&
         std::all_of(held.begin(), held.end(), commanded);
}

SquaredError error_of(const PlantModel<double>& plant, const DriveController& controller,
                      const MotorTrace& trace, const DriveState<double>& start, std::size_t scored_from) {
  DriveStepper<double> stepper = reference::stepper_for(plant, trace);
  const DriveState<double> drive = reference::behind_the_sensor(plant, stepper, start);
  const std::vector<double> x = positions_under_controller(plant, controller, trace, drive);
  if (x.empty()) return {};
  SquaredError e{0.0, static_cast<double>(trace.size() - scored_from)};
  for (std::size_t i = scored_from; i < trace.size(); ++i) e.sum += std::pow(trace.x1[i] - x[i], 2);
  return e;
}

std::vector<SquaredError> errors_of(const Study& study, const ReferenceModel& model) {
  const HeldOut& held = study.held_out;
  const auto starts = settled_starts(held.traces, model, study.observer_hz);
  ReferenceModel drive = all_fixed(model);
  drive.controller.reset();  // whose delay acts in the loop
  const reference::ModelRun run =
      reference::ModelFit(held.traces, drive, {}, study.observer_hz).run_at({{}, starts});
  const DriveController controller =
      model.controller ? model.controller->at_start() : *study.options.controller;
  std::vector<SquaredError> errors;
  for (std::size_t r = 0; r < held.traces.size(); ++r)
    errors.push_back(error_of(run.plant, controller, held.traces[r], run.starts[r], held.scored_from[r]));
  return errors;
}

double pooled(const std::vector<SquaredError>& errors) {
  SquaredError all{0.0, 0.0};
  for (const SquaredError& e : errors) all.sum += e.sum, all.samples += e.samples;
  return all.rms();
}

}  // namespace

std::optional<ClosedLoop> judged_under_controller(const Study& study, const ReferenceModel& before,
                                                  const ReferenceModel& after) {
  if (!has_controller(study)) return {};
  const std::vector<SquaredError> b = errors_of(study, before), a = errors_of(study, after);
  ClosedLoop judged{pooled(b), pooled(a), {}};
  for (std::size_t r = 0; r < b.size(); ++r)
    judged.recordings.push_back({study.held_out.traces[r].file, b[r].rms(), a[r].rms()});
  return judged;
}

}  // namespace gapscope::internal::diagnosis
