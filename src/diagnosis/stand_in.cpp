#include "diagnosis/stand_in.h"

#include <algorithm>
#include <cmath>

#include "reference/observer.h"

namespace gapscope::internal::diagnosis {
namespace {

std::vector<MotorTrace> simulated(const std::vector<Stretch>& stretches) {
  std::vector<MotorTrace> traces;
  for (const Stretch& s : stretches) traces.push_back(s.simulator);
  return traces;
}

}  // namespace

FreeRuns free_runs(const ReferenceModel& model, const std::vector<MotorTrace>& traces,
                   const std::vector<reference::RecordingStart>& starts) {
  const reference::ModelRun run = reference::ModelFit(traces, all_fixed(model), {}, 0.0).run_at({{}, starts});
  FreeRuns runs(traces.size());
  for (std::size_t r = 0; r < traces.size(); ++r) {
    const auto keep = [&](std::size_t, const DriveStepper<double>& stepper) {
      runs[r].push_back(stepper.measured());
    };
    if (!reference::roll_out(run.plant, run.starts[r], traces[r], reference::ObserverGains(), keep))
      runs[r].clear();
  }
  return runs;
}

StandIn::StandIn(ReferenceModel model, std::vector<Stretch> stretches)
    : model_(std::move(model)),
      stretches_(std::move(stretches)),
      simulated_(simulated(stretches_)),
      starts_(settled_starts(simulated_, model_, 0.0)) {}

/// @param error of sample i of recording r
template <class Value>
double StandIn::rms(Value&& error) const {
  double sum = 0.0, samples = 0.0;
  for (std::size_t r = 0; r < stretches_.size(); ++r)
    for (std::size_t i = stretches_[r].from; i < stretches_[r].to; ++i, samples += 1.0) {
      const double e = error(r, i);
      sum += e * e;
    }
  return std::sqrt(sum / std::max(1.0, samples));
}

double StandIn::simulator_error() const {
  return rms([&](std::size_t r, std::size_t i) { return stretches_[r].drive.x1[i] - simulated_[r].x1[i]; });
}

double StandIn::error_of(const ReferenceModel& model) const {
  const FreeRuns runs = runs_of(model);
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.empty(); })) return kInfinity;
  return rms([&](std::size_t r, std::size_t i) { return stretches_[r].drive.x1[i] - runs[r][i]; });
}

double StandIn::miss() const {
  const FreeRuns runs = runs_of(model_);
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.empty(); })) return kInfinity;
  return rms([&](std::size_t r, std::size_t i) { return simulated_[r].x1[i] - runs[r][i]; });
}

}  // namespace gapscope::internal::diagnosis
