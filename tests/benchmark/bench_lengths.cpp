// The cost is linear in the samples and in the events.
#include "benchmark/measure.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::benchmarks {
namespace {

void samples(benchmark::State& state) {
  const auto u = test::several_sines(kAmplitude, kRate, static_cast<double>(state.range(0)) / kRate);
  measure(state, plant_model(test::paper_rig(), {}), u);
  state.SetComplexityN(state.range(0));
}

double time_of(DriveStepper<double>& stepper, const std::vector<double>& u, int times) {
  const double start = cpu_seconds();
  for (int i = 0; i < times; ++i) play(stepper, u);
  return (cpu_seconds() - start) / times;
}

/// As many samples with more or fewer events: what a run takes beyond one without any event, per event. Both
/// are measured in turn, and the least of each counts.
void events(benchmark::State& state) {
  const double amplitude = static_cast<double>(state.range(0)) / 10.0;
  const auto u = test::several_sines(amplitude, kRate, kDuration);
  const std::vector<double> rest(u.size(), 0.0);
  DriveStepper<double> stepper(plant_model(test::paper_rig(), {}), 1.0 / kRate);
  double quiet = 1e9, busy = 1e9;
  for (auto _ : state) {
    quiet = std::min(quiet, time_of(stepper, rest, 10));
    const double t = time_of(stepper, u, 5);
    busy = std::min(busy, t);
    state.SetIterationTime(t);
  }
  const auto count = static_cast<double>(stepper.events());
  state.counters["events"] = count;
  state.counters["s/event"] = (busy - quiet) / count;
}

const bool kRegistered = [] {
  repeat(benchmark::RegisterBenchmark("samples", samples)
             ->RangeMultiplier(2)
             ->Range(2000, 128000)
             ->Complexity(benchmark::oN));
  repeat(benchmark::RegisterBenchmark("events/tenths_of_amplitude", events)
             ->Arg(1)
             ->Arg(2)
             ->Arg(6)
             ->Arg(12)
             ->Arg(24)
             ->UseManualTime()
             ->Iterations(15));
  return true;
}();

}  // namespace
}  // namespace gapscope::benchmarks
