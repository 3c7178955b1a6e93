// One run of the paper's rig: plain, with an effect of each kind of hook, and with Jets.
#include <array>
#include <string>

#include "benchmark/measure.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::benchmarks {
namespace {

struct EffectCase {
  const char* hook;
  const char* name;
  std::vector<double> values;
};

const std::vector<EffectCase>& effect_cases() {
  static const std::vector<EffectCase> cases = {
      {"shape", "motor_coulomb_friction", {0.01}},
      {"command", "input_dead_zone", {0.05}},
      {"delay", "input_delay", {1.37 / kRate}},
      {"torque", "cogging_torque", {0.01, 24.0, 0.4, 0.1, 0.0, 0.0, 0.0}},
      {"decay", "actuator_lag", {3.0 / kRate}},
      {"half_gap", "gap_eccentricity", {0.005, 0.4, 1.0}},
      {"load_inertia", "load_inertia_variation", {0.5, 3.0, 1.0}},
      {"sense", "encoder_eccentricity", {0.001, 0.4, 1.0}},
      {"advance", "presliding_friction", {0.01, 0.005, 0.0}},
      {"substeps", "load_resonance", {0.2, 0.2 * kRate, 0.05, 0.0, 0.0}}};
  return cases;
}

/// The rig with as many of its numbers as the Jet holds for derivatives.
template <class T>
PlantModel<T> rig() {
  PlantModel<T> model;
  const DriveParameters<double> numbers = test::paper_rig();
  for (int i = 0; i < kDriveParameterCount; ++i) {
    T& p = drive_parameter(model.drive, i);
    p = T(drive_parameter(numbers, i));
    if constexpr (kIsJet<T>)
      if (i < T::DIMENSION) p.v[i] = 1.0;
  }
  return model;
}

template <class T>
PlantModel<T> rig_with(const EffectCase& effect) {
  PlantModel<T> model = rig<T>();
  const std::vector<T> values(effect.values.begin(), effect.values.end());
  add_effect<T>(model, *find_effect(effect.name), values);
  return model;
}

std::vector<double> sine_input() { return test::sine(kAmplitude, 1.0, kRate, kDuration); }
std::vector<double> several_sines_input() { return test::several_sines(kAmplitude, kRate, kDuration); }

template <class T>
void add(const std::string& name, const PlantModel<T>& model, const std::vector<double>& u) {
  repeat(benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) { measure(s, model, u); }));
}

/// The simulator with everything around it: a recording with a noisy encoder.
void add_recording(const std::vector<double>& u) {
  SimulationOptions options;
  options.rate = kRate;
  options.encoder = {6e-6, 1e-6};
  repeat(benchmark::RegisterBenchmark("recording/several_sines", [=](benchmark::State& s) {
    for (auto _ : s) benchmark::DoNotOptimize(simulate(rig<double>(), u, options));
  }));
}

const bool kRegistered = [] {
  const std::vector<double> one = sine_input(), several = several_sines_input();
  add("plain/sine", rig<double>(), one);
  add("plain/several_sines", rig<double>(), several);
  add_recording(several);
  for (const EffectCase& c : effect_cases())
    add(std::string(c.hook) + "/" + c.name, rig_with<double>(c), several);
  add("jet8/sine", rig<Jet<8>>(), one);
  add("jet8/several_sines", rig<Jet<8>>(), several);
  add("jet12/sine", rig<Jet<12>>(), one);
  add("jet12/several_sines", rig<Jet<12>>(), several);
  add("jet12/cogging_torque", rig_with<Jet<12>>(effect_cases()[3]), several);
  add("jet12/load_resonance", rig_with<Jet<12>>(effect_cases().back()), several);
  return true;
}();

}  // namespace
}  // namespace gapscope::benchmarks
