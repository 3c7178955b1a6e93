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

namespace {

/// Of x̂ about a recording, and of the recording about its mean.
HeldOutRun measured(const MotorTrace& trace, const std::vector<double>& x) {
  HeldOutRun run{trace.file, trace.time(0), trace.time(trace.size() - 1)};
  if (x.empty()) return run;
  const double centre = mean(trace.x1), count = static_cast<double>(trace.size());
  double square = 0.0, size = 0.0, motion = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    square += std::pow(trace.x1[i] - x[i], 2), size += std::abs(trace.x1[i] - x[i]);
    motion += std::pow(trace.x1[i] - centre, 2);
  }
  run.rmse = std::sqrt(square / count), run.mae = size / count;
  run.fit = 100.0 * (1.0 - std::sqrt(square / motion));
  return run;
}

/// The same study, of which what is held out begins where it is judged.
Study of_judged_parts(const Study& study) {
  Study judged = study;
  HeldOut& held = judged.held_out;
  for (std::size_t r = 0; r < held.traces.size(); ++r) {
    const std::size_t from = std::exchange(held.scored_from[r], 0);
    held.traces[r] = part(held.traces[r], from, held.traces[r].size() - from);
  }
  held.input_factors.clear();  // of whole recordings, and no controller's
  return judged;
}

}  // namespace

std::vector<HeldOutRun> held_out_runs(const Study& study, const ReferenceModel& nominal,
                                      const ReferenceModel& fitted) {
  const Study judged = of_judged_parts(study);
  const auto runs = [&](const ReferenceModel& model, bool& closed) {
    Positions positions = runs_under_controller(judged, model);
    closed = !positions.empty();
    return closed ? positions : judged_runs(model, study.held_out, study.observer_hz);
  };
  bool closed = false;
  const Positions before = runs(nominal, closed), after = runs(fitted, closed);
  std::vector<HeldOutRun> told;
  for (std::size_t r = 0; r < judged.held_out.traces.size(); ++r) {
    const MotorTrace& trace = judged.held_out.traces[r];
    const auto of = [&](const Positions& all) {
      return measured(trace, r < all.size() ? all[r] : std::vector<double>());
    };
    told.push_back(of(after));
    told.back().closed = closed, told.back().nominal_fit = of(before).fit;
  }
  return told;
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
  d.held_out_runs = held_out_runs(study, nominal, d.fitted);
  const auto& [before, after] = held.first.empty() ? free : held;
  for (std::size_t r = 0; r < d.traces.size(); ++r) {
    if (r < before.size()) d.traces[r].simulated_before = before[r];
    if (added && r < after.size()) d.traces[r].simulated_after = after[r];
  }
}

}  // namespace gapscope::internal::diagnosis
