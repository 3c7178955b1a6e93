#include "run/simulated_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.h"
#include "config/configuration.h"
#include "exports/export.h"
#include "exports/mujoco_engine.h"
#include "gapscope/base/statistics.h"
#include "independent_plant/simulate.h"

namespace gapscope::test {
namespace {

constexpr double kRate = 500.0, kDuration = 3.0;
constexpr int kBits = 18;
constexpr double kInertia = 8.78e-4, kTorqueConstant = 0.172, kUnbalancePhase = 0.7;

/// Of one body or two: sines of changing size, then of another kind.
std::vector<double> input(bool held_out, double peak) {
  std::vector<double> u;
  for (int i = 0; i < static_cast<int>(kRate * kDuration); ++i) {
    const double t = i / kRate, slow = 2.0 * kPi * t;
    u.push_back(peak * (held_out ? 0.6 * std::sin(0.8 * slow) + 0.4 * std::sin(2.7 * slow)
                                 : std::sin(1.1 * slow) * (0.7 + 0.3 * std::sin(0.37 * slow))));
  }
  return u;
}

double knob(const SimulatedPair& pair, const char* name, bool drive) {
  const Knob* k = pair.find(name);
  return k == nullptr ? 0.0 : drive ? k->drive : k->simulator;
}

independent_plant::BlindDrive blind_drive(const SimulatedPair& p) {
  independent_plant::BlindDrive d;
  if (!p.has_load) d.load = independent_plant::BlindLoad::kNone;
  d.motor_inertia = p.has_load ? kInertia : knob(p, "motor_inertia", true);
  d.motor_damping = knob(p, "motor_damping", true);
  if (p.has_load) d.load_inertia = kInertia * knob(p, "mass_ratio", true);
  d.load_damping = knob(p, "load_damping", true);
  d.load_coulomb = knob(p, "load_coulomb_friction", true);
  d.gap = knob(p, "gap", true);
  d.effects.motor.friction.level_nm = knob(p, "motor_coulomb_friction", true);
  d.effects.motor.cogging.amplitude = knob(p, "cogging_torque", true);
  d.effects.motor.cogging.periods_per_turn = p.detents_per_turn;
  d.effects.command.delay_s = knob(p, "input_delay", true);
  d.effects.command.lag_s = knob(p, "actuator_lag", true);
  d.effects.load.unbalance_nm = knob(p, "load_unbalance", true);
  d.effects.load.unbalance_phase_rad = kUnbalancePhase;
  d.effects.load.constant_torque_nm = knob(p, "constant_load_torque", true);
  return d;
}

/// What the simulator's author has written down.
std::string simulator_yaml(const SimulatedPair& p) {
  std::string effects;
  for (const auto& [name, key] :
       {std::pair("motor_coulomb_friction", "level_nm"), std::pair("actuator_lag", "time_constant_s"),
        std::pair("load_unbalance", "amplitude_nm"), std::pair("constant_load_torque", "torque_nm")})
    if (const double amount = knob(p, name, false); amount > 0.0)
      effects += fmt::format(
          "{}{{{}: {{{}: {}{}}}}}", effects.empty() ? "" : ", ", name, key, amount,
          std::string(name) == "load_unbalance" ? fmt::format(", phase_rad: {}", kUnbalancePhase) : "");
  const std::string load = p.has_load
                               ? fmt::format(
                                     "mass_ratio: {}, gap: {}, load_damping: {}, load_coulomb_friction: {}, "
                                     "contact_stiffness: 200, contact_damping: 0.05",
                                     knob(p, "mass_ratio", false), knob(p, "gap", false),
                                     knob(p, "load_damping", false), knob(p, "load_coulomb_friction", false))
                               : std::string("mass_ratio: 0");
  return fmt::format(
      "name: theirs\nencoder: {{bits: 20}}\n"
      "simulation: {{rate: 1000, duration: 2, excitation: {{sine: {{amplitude: 0.6, frequency: 1}}}}}}\n"
      "model:\n  parameters: {{motor_inertia: {}, torque_constant: {}, motor_damping: {}, {}}}\n  effects: [{}]\n",
      p.has_load ? kInertia : knob(p, "motor_inertia", false), kTorqueConstant,
      knob(p, "motor_damping", false), load, effects);
}

Recording by_engine(const SimulatedPair& p, const Recording& drive) {
  const DriveExport model =
      export_drive(parse_configuration(simulator_yaml(p), "theirs.yaml"), ExportFormat::kMjcf);
  testing::MujocoEngineRun engine(model.files[0].text);
  const auto inner = static_cast<std::size_t>(std::lround(drive.dt / p.step));
  const auto late = static_cast<std::size_t>(std::lround(p.input_late / p.step));
  std::vector<double> fine;
  for (std::size_t i = 0; i < drive.size() * inner; ++i)
    fine.push_back(i < late ? 0.0 : drive.u[(i - late) / inner]);
  const std::vector<double> x1 = engine.motion(p.step, p.runge_kutta ? mjINT_RK4 : mjINT_EULER, fine);
  if (x1.size() <= fine.size()) throw std::runtime_error("the engine's motion diverges");
  Recording r = drive;
  const double quantum = EncoderConfig::quantum_of(kBits);
  for (std::size_t i = 0; i < r.size(); ++i) r.x1[i] = quantum * std::round(x1[i * inner] / quantum);
  r.file = "sim.csv", r.x2.clear(), r.mode.clear(), r.quantum = quantum;
  return r;
}

/// The drive's number and, in `others` of the pairs' numbers, another one of the simulator's.
template <class Random>
Knob drawn(Random& random, const char* name, double low, double high, bool other) {
  Knob k{name, std::exp(uniform(random, std::log(low), std::log(high))), 0.0};
  k.simulator = k.drive;
  if (other)
    k.simulator *= uniform(random, 0.0, 1.0) < 0.5 ? uniform(random, 0.6, 0.85) : uniform(random, 1.2, 1.6);
  return k;
}

/// Each of its numbers is another one in the simulator in a third of the pairs, each effect is there in half.
template <class Random>
void draw_knobs(Random& random, bool same, SimulatedPair& p) {
  const auto other = [&] { return !same && uniform(random, 0.0, 1.0) < 0.33; };
  const auto effect = [&](const char* name, double low, double high, bool simulator_can) {
    Knob k = drawn(random, name, low, high, other());
    const double draw = uniform(random, 0.0, 1.0);
    if (draw < 0.5) return;
    if (!same && draw > 0.75)
      k.simulator = 0.0;
    else if (!same && simulator_can && draw > 0.65)
      k.drive = 0.0;
    if (!simulator_can && k.simulator > 0.0) {
      if (same) return;
      k.simulator = 0.0;
    }
    p.knobs.push_back(k);
  };
  p.knobs.push_back(drawn(random, "motor_damping", 0.03, 0.08, other()));
  if (p.has_load) {
    p.knobs.push_back(drawn(random, "mass_ratio", 0.5, 2.0, other()));
    p.knobs.push_back(drawn(random, "gap", 0.01, 0.03, other()));
    p.knobs.push_back(drawn(random, "load_damping", 0.02, 0.05, false));
    p.knobs.push_back(drawn(random, "load_coulomb_friction", 0.02, 0.05, other()));
  } else {
    p.knobs.push_back(drawn(random, "motor_inertia", 1e-3, 3e-3, other()));
  }
  effect("motor_coulomb_friction", 0.005, 0.02, true);
  effect("cogging_torque", 0.003, 0.012, false);
  if (uniform(random, 0.0, 1.0) < 0.5)
    effect("input_delay", 1.5e-3, 6e-3, true);
  else
    effect("actuator_lag", 1.5e-3, 6e-3, true);
  effect(uniform(random, 0.0, 1.0) < 0.5 ? "load_unbalance" : "constant_load_torque", 4e-3, 1.2e-2, true);
}

ReferenceModel sheet_of(const SimulatedPair& p, std::uint64_t seed) {
  auto random = random_stream(seed, "sheet");
  const auto near = [&](const char* name) {
    return ParameterSetting::sought(knob(p, name, true) * uniform(random, 0.8, 1.2));
  };
  ReferenceModel m;
  m.structure.has_load = p.has_load;
  m.set("torque_constant", ParameterSetting::known(kTorqueConstant));
  m.set("motor_damping", near("motor_damping"));
  m.set("motor_inertia", p.has_load ? ParameterSetting::known(kInertia) : near("motor_inertia"));
  if (!p.has_load) return m;
  for (const char* name : {"mass_ratio", "gap", "load_damping", "load_coulomb_friction"})
    m.set(name, near(name));
  m.set("contact_stiffness", ParameterSetting::known(200.0));
  m.set("contact_damping", ParameterSetting::known(0.05));
  return m;
}

}  // namespace

const Knob* SimulatedPair::find(const std::string& name) const {
  for (const Knob& k : knobs)
    if (k.name == name) return &k;
  return nullptr;
}

double SimulatedPair::shape_of(const std::string& effect, const EffectParameterSpec& parameter) const {
  const std::string_view key = parameter.key;
  if (effect == "cogging_torque" && key == "periods_per_turn") return detents_per_turn;
  if (effect == "load_unbalance" && key == "phase_rad") return kUnbalancePhase;
  return parameter.absent;
}

SimulatedPair draw_pair(std::uint64_t seed, bool same) {
  auto random = random_stream(seed, "simulated_pair");
  SimulatedPair p;
  p.has_load = uniform(random, 0.0, 1.0) < 0.5;
  p.detents_per_turn = 40.0 + static_cast<double>(seed % 5) * 6.0;
  constexpr double kSteps[] = {1e-4, 5e-4, 1e-3, 2e-3};
  p.step = kSteps[static_cast<int>(uniform(random, 0.0, 4.0))];
  p.runge_kutta = uniform(random, 0.0, 1.0) < 0.4;
  const bool shifted = !same && uniform(random, 0.0, 1.0) < 0.2;
  draw_knobs(random, same, p);
  if (shifted && p.find("input_delay") == nullptr && p.find("actuator_lag") == nullptr)
    p.knobs.push_back({"input_delay", 0.0, 1.0 / kRate});
  for (Knob& k : p.knobs) {
    if (k.name != "input_delay" || k.simulator <= 0.0) continue;
    const bool alike = k.simulator == k.drive;
    k.simulator = p.input_late = p.step * std::max(1.0, std::round(k.simulator / p.step));
    if (alike) k.drive = k.simulator;
  }
  const independent_plant::BlindSensor sensor = independent_plant::BlindSensor::with_bits(kBits, 0.5);
  const double peak = p.has_load ? 0.8 : 1.0;
  for (const bool held_out : {false, true}) {
    const independent_plant::BlindOptions options{kRate, kDuration, seed + (held_out ? 1000000 : 0),
                                                  independent_plant::kFastTolerance};
    Recording drive =
        independent_plant::simulate_blind_command(blind_drive(p), input(held_out, peak), sensor, options)
            .recording;
    drive.file = held_out ? "held_out.csv" : "drive.csv";
    (held_out ? p.simulated_held_out : p.simulated_train) = by_engine(p, drive);
    (held_out ? p.held_out : p.train) = std::move(drive);
  }
  p.sheet = sheet_of(p, seed);
  return p;
}

}  // namespace gapscope::test
