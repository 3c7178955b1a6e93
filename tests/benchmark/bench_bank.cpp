// A bank of bounds against one bound, and its cost against the number of samples.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "benchmark/clock.h"
#include "sliding_mode/bound_bank.h"

namespace gapscope::benchmarks {
namespace {

constexpr double kStep = 4e-4;  // [s]

std::vector<double> encoder_signal(std::size_t samples) {
  std::vector<double> y(samples);
  for (std::size_t i = 0; i < samples; ++i)
    y[i] = 6e-6 * std::round(0.1 * std::sin(2e-3 * static_cast<double>(i)) / 6e-6);
  return y;
}

std::vector<double> bounds(std::size_t count) {
  std::vector<double> L(count);
  for (std::size_t j = 0; j < count; ++j) L[j] = std::pow(1.3, static_cast<double>(j));
  return L;
}

/// Time of one run [s].
template <class Run>
double time_of(const Run& run) {
  const double start = cpu_seconds();
  run();
  return cpu_seconds() - start;
}

/// The bank next to one differentiator over the same samples, measured in turn; the least of each counts.
void bank(benchmark::State& state, Discretisation discretisation, std::size_t count) {
  const auto y = encoder_signal(200000);
  std::vector<double> errors(y.size() * count);
  double one = 1e9, all = 1e9;
  for (auto _ : state) {
    SuperTwistingDifferentiator single(5.0, discretisation);
    one = std::min(one, time_of([&] {
                     for (const double sample : y) benchmark::DoNotOptimize(single.step(sample, kStep));
                   }));
    BoundBank many(bounds(count), discretisation);
    all = std::min(all, time_of([&] { many.run(y, kStep, errors); }));
    benchmark::DoNotOptimize(errors.data());
    state.SetIterationTime(all);
  }
  const auto samples = static_cast<double>(y.size());
  state.counters["one_ns"] = 1e9 * one / samples;
  state.counters["bank_ns"] = 1e9 * all / samples;
  state.counters["ratio"] = all / one;
}

void bank_samples(benchmark::State& state) {
  const auto y = encoder_signal(static_cast<std::size_t>(state.range(0)));
  std::vector<double> errors(y.size() * 16);
  for (auto _ : state) {
    BoundBank many(bounds(16));
    many.run(y, kStep, errors);
    benchmark::DoNotOptimize(errors.data());
  }
  state.SetComplexityN(state.range(0));
}

const bool kRegistered = [] {
  for (const Discretisation d : {Discretisation::kForwardEuler, Discretisation::kSemiImplicit,
                                 Discretisation::kImplicit, Discretisation::kMatched})
    for (const std::size_t count : {16u, 24u})
      benchmark::RegisterBenchmark(
          (std::string("bank/") + to_string(d) + "/" + std::to_string(count)).c_str(),
          [=](benchmark::State& state) { bank(state, d, count); })
          ->UseManualTime()
          ->Iterations(30)
          ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("bank_samples", bank_samples)
      ->RangeMultiplier(2)
      ->Range(4000, 256000)
      ->Unit(benchmark::kMillisecond)
      ->Complexity(benchmark::oN);
  return true;
}();

}  // namespace
}  // namespace gapscope::benchmarks
