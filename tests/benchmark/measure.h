#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <span>
#include <vector>

#include "benchmark/clock.h"
#include "gapscope/simulation/stepper.h"
#include "simulation/drives.h"

namespace gapscope::benchmarks {

constexpr double kRate = 2000.0;    ///< [Hz]
constexpr double kDuration = 8.0;   ///< [s]
constexpr double kAmplitude = 0.6;  ///< [unit of u]

/// From rest through the whole input.
template <class T>
void play(DriveStepper<T>& stepper, std::span<const double> u) {
  stepper.reset({});
  for (const double v : u) stepper.step(T(v));
  benchmark::DoNotOptimize(stepper.state());
}

template <class T>
void measure(benchmark::State& state, const PlantModel<T>& model, const std::vector<double>& u) {
  DriveStepper<T> stepper(model, 1.0 / kRate);
  for (auto _ : state) play(stepper, u);
  if (!stepper.healthy()) state.SkipWithError("the motion diverged");
  state.counters["events"] = static_cast<double>(stepper.events());
  state.counters["s/sample"] =
      benchmark::Counter(static_cast<double>(u.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

inline double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

/// Minimum beside the usual median: the other programs on the machine only ever add time.
inline void repeat(benchmark::internal::Benchmark* b, int times = 9) {
  b->Unit(benchmark::kMillisecond)
      ->Repetitions(times)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("min", least);
}

}  // namespace gapscope::benchmarks
