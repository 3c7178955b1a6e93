#include "reference/free_run.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "reference/observer.h"

namespace gapscope::internal::reference {
namespace {

constexpr std::size_t kParts = 100;  ///< of a recording, in which the way is compared

double error(const FitProblem& problem, const std::vector<FitTrace>& traces,
             const std::vector<double>& (*column)(const FitTrace&)) {
  double sum = 0.0, count = 0.0;
  for (std::size_t r = 0; r < traces.size(); ++r) {
    const std::vector<double>& x = column(traces[r]);
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(problem.recordings[r].x1[i] - x[i], 2);
    count += static_cast<double>(x.size());
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNaN;
}

}  // namespace

DriveState<double> start_state(const FitProblem& problem, const FitPoint& at, std::size_t r) {
  const double gap = problem.numbers(at.q.data()).drive(place::kGap);
  return problem.state(at.starts[r], 0.5 * gap, at.starts[r].q.data());
}

FitTrace trace_of(const FitProblem& problem, const FitPoint& at, std::size_t r, double observer_hz) {
  const MotorTrace& recording = problem.recordings[r];
  const ModelNumbers<double> numbers = problem.numbers(at.q.data());
  const PlantModel<double> model = problem.plant_model(numbers);
  const DriveState<double> start = start_state(problem, at, r);
  const std::vector<double> commanded =
      problem.controller ? problem.commanded(numbers, r) : std::vector<double>();
  const std::span<const double> u =
      problem.controller ? std::span<const double>(commanded) : stepped_input(recording);
  const bool has_load = problem.structure.has_load;
  FitTrace t;
  t.file = recording.file;
  t.encoder = problem.structure.reads_load() ? EncoderSide::kLoad : EncoderSide::kMotor;
  if (!roll_out(model, start, recording, u, {}, [&](std::size_t, const DriveStepper<double>& stepper) {
        const bool load = t.encoder == EncoderSide::kLoad;
        t.x1.push_back(load ? stepper.state().x1 : stepper.measured());
        if (has_load) t.x2.push_back(load ? stepper.measured() : stepper.state().x2);
        t.mode.push_back(mode_of(stepper));
      })) {
    t.x1.clear(), t.x2.clear(), t.mode.clear();
  }
  const ObserverGains gains(observer_hz, recording);
  if (!roll_out(model, start, recording, u, gains, [&](std::size_t, const DriveStepper<double>& stepper) {
        t.predicted.push_back(stepper.measured());
      }))
    t.predicted.clear();
  return t;
}

double free_run_error(const FitProblem& problem, const std::vector<FitTrace>& traces) {
  return error(problem, traces, [](const FitTrace& t) -> const std::vector<double>& { return t.position(); });
}
double prediction_error(const FitProblem& problem, const std::vector<FitTrace>& traces) {
  return error(problem, traces, [](const FitTrace& t) -> const std::vector<double>& { return t.predicted; });
}

double error_over_stillness(const FitProblem& problem, const std::vector<FitTrace>& traces) {
  double missed = 0.0, moved = 0.0, missed_ways = 0.0, ways = 0.0;
  for (std::size_t r = 0; r < traces.size(); ++r) {
    const std::span<const double> x = problem.recordings[r].x1;
    const std::vector<double>& run = traces[r].position();
    const double center = mean(x);
    const std::size_t part = std::max<std::size_t>(1, x.size() / kParts);
    for (std::size_t i = 0; i < run.size(); ++i)
      missed += std::pow(x[i] - run[i], 2), moved += std::pow(x[i] - center, 2);
    for (std::size_t i = part; i < run.size(); ++i) {
      const double way = x[i] - x[i - part];
      missed_ways += std::pow(way - (run[i] - run[i - part]), 2), ways += way * way;
    }
  }
  return std::sqrt(std::min(missed / moved, missed_ways / ways));
}

std::vector<ModeError> errors_by_mode(const FitProblem& problem, const std::vector<FitTrace>& traces) {
  std::vector<ModeError> errors;
  if (!problem.structure.has_load) return errors;
  for (const Mode mode : {Mode::kGap, Mode::kEngagementPlus, Mode::kEngagementMinus, Mode::kImpact}) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t r = 0; r < traces.size(); ++r)
      for (std::size_t i = 0; i < traces[r].position().size(); ++i)
        if (traces[r].mode[i] == mode)
          sum += std::pow(problem.recordings[r].x1[i] - traces[r].position()[i], 2), ++count;
    if (count > 0) errors.push_back({mode, count, std::sqrt(sum / count)});
  }
  return errors;
}

}  // namespace gapscope::internal::reference
