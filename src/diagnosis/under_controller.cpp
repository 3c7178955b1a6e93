#include "diagnosis/under_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/mismatch_size.h"
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

SquaredError error_of(const MotorTrace& trace, const std::vector<double>& x, std::size_t scored_from) {
  if (x.empty()) return {};
  SquaredError e{0.0, static_cast<double>(trace.size() - scored_from)};
  for (std::size_t i = scored_from; i < trace.size(); ++i) e.sum += std::pow(trace.x1[i] - x[i], 2);
  return e;
}

std::vector<SquaredError> errors_of(const HeldOut& held, const Positions& positions) {
  std::vector<SquaredError> errors;
  for (std::size_t r = 0; r < positions.size(); ++r)
    errors.push_back(error_of(held.traces[r], positions[r], held.scored_from[r]));
  return errors;
}

double pooled(const std::vector<SquaredError>& errors) {
  SquaredError all{0.0, 0.0};
  for (const SquaredError& e : errors) all.sum += e.sum, all.samples += e.samples;
  return all.rms();
}

}  // namespace

Positions runs_under_controller(const Study& study, const ReferenceModel& model) {
  if (!has_controller(study)) return {};
  const HeldOut& held = study.held_out;
  const auto starts = settled_starts(held.traces, model, study.observer_hz);
  ReferenceModel drive = all_fixed(model);
  drive.controller.reset();  // whose delay acts in the loop
  const reference::ModelRun run =
      reference::ModelFit(held.traces, drive, {}, study.observer_hz).run_at({{}, starts});
  const DriveController controller =
      model.controller ? model.controller->at_start() : *study.options.controller;
  Positions positions;
  for (std::size_t r = 0; r < held.traces.size(); ++r) {
    DriveStepper<double> stepper = reference::stepper_for(run.plant, held.traces[r]);
    const DriveState<double> start = reference::behind_the_sensor(run.plant, stepper, run.starts[r]);
    positions.push_back(positions_under_controller(run.plant, controller, held.traces[r], start));
  }
  return positions;
}

std::optional<ClosedLoop> judged_under_controller(const HeldOut& held, const Positions& before,
                                                  const Positions& after) {
  if (before.empty()) return {};
  const std::vector<SquaredError> b = errors_of(held, before), a = errors_of(held, after);
  ClosedLoop judged{pooled(b), pooled(a), {}};
  for (std::size_t r = 0; r < b.size(); ++r)
    judged.recordings.push_back({held.traces[r].file, b[r].rms(), a[r].rms()});
  return judged;
}

void tell_whole_runs(const Study& study, const ReferenceModel& nominal, bool added, Diagnosis& d) {
  const auto both = [&](const auto& runs) {
    Positions before = runs(nominal);
    return std::pair(before, added ? runs(d.fitted) : before);
  };
  const auto free =
      both([&](const ReferenceModel& m) { return whole_runs(m, study.held_out, study.observer_hz); });
  const auto held = both([&](const ReferenceModel& m) { return runs_under_controller(study, m); });
  d.whole_run = whole_run(study.held_out, free.first, free.second);
  d.closed_loop = judged_under_controller(study.held_out, held.first, held.second);
  const auto& [before, after] = held.first.empty() ? free : held;
  for (std::size_t r = 0; r < d.traces.size(); ++r) {
    if (r < before.size()) d.traces[r].simulated_before = before[r];
    if (added && r < after.size()) d.traces[r].simulated_after = after[r];
  }
}

}  // namespace gapscope::internal::diagnosis
