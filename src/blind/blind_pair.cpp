#include "blind/blind_pair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "base/random.h"
#include "engine_plant/mujoco_plant.h"

namespace gapscope::blind {
namespace {

independent_plant::BlindCase rig_case(const std::string& rig) {
  independent_plant::BlindCase c;
  independent_plant::BlindDrive& d = c.drive;
  c.options.tolerance = independent_plant::kFastTolerance;
  if (rig == "geared") {
    d.load_inertia = 3.0 * d.motor_inertia;
    d.motor_damping = 0.02, d.load_damping = 0.02, d.load_coulomb = 0.03;
    d.gap = 30e-3, d.contact_stiffness = 120.0, d.contact_damping = 0.08;
    c.sensor = independent_plant::BlindSensor::with_bits(14, 0.5);
    c.options.rate = 1000.0;
  } else if (rig == "heavy") {
    d.load_inertia = 8.0 * d.motor_inertia;
    d.motor_damping = 0.03, d.load_damping = 0.03, d.load_coulomb = 0.06;
    d.gap = 6e-3, d.contact_stiffness = 600.0, d.contact_damping = 0.15;
    c.sensor = independent_plant::BlindSensor::with_bits(17);
    c.options.rate = 2000.0;
  } else {
    c.sensor = independent_plant::BlindSensor::with_bits(20);
    c.options.rate = 1250.0;
  }
  return c;
}

void vary(independent_plant::BlindDrive& d, std::uint64_t seed) {
  auto g = random_stream(seed, "diagnosis rig");
  for (double* v : {&d.motor_damping, &d.load_inertia, &d.load_damping, &d.load_coulomb, &d.gap,
                    &d.contact_stiffness, &d.contact_damping})
    *v *= 1.0 + uniform(g, -0.2, 0.2);
}

/// Torque from two to eight times the load's friction; slow enough for several radians in half of the cases.
void excite(independent_plant::BlindCase& c, independent_plant::Waveform waveform, std::mt19937_64& g) {
  c.excitation.waveform = waveform;
  c.excitation.amplitude = c.drive.load_coulomb * log_uniform(g, 3.0, 8.0) / c.drive.torque_constant;
  c.excitation.frequency = log_uniform(g, 0.25, 1.5);
  if (waveform == independent_plant::Waveform::kMultisine ||
      waveform == independent_plant::Waveform::kSweptSine)
    c.excitation.frequency_end = log_uniform(g, 3.0, 8.0), c.excitation.frequency = log_uniform(g, 0.2, 0.5);
}

constexpr std::uint64_t kNextDraw = 0x9e3779b97f4a7c15;  ///< a second effect draws from a seed far away

constexpr std::array kWaveforms{
    independent_plant::Waveform::kSine,      independent_plant::Waveform::kMultisine,
    independent_plant::Waveform::kSweptSine, independent_plant::Waveform::kTriangle,
    independent_plant::Waveform::kTrapezoid, independent_plant::Waveform::kSteps};

void set(ReferenceModel& model, int index, double value, bool estimate) {
  ParameterSetting& p = model.parameters[index];
  p.value = value;
  p.estimate = estimate;
}

/// Contact stiffness and damping are known, the rest is a start.
ReferenceModel sheet_model(const independent_plant::BlindDrive& true_drive,
                           const independent_plant::BlindDrive& sheet) {
  ReferenceModel model;
  set(model, place::kMotorInertia, sheet.motor_inertia, false);
  set(model, place::kTorqueConstant, sheet.torque_constant, false);
  set(model, place::kMotorDamping, sheet.motor_damping, true);
  set(model, place::kMassRatio, sheet.load_inertia / sheet.motor_inertia, true);
  set(model, place::kGap, sheet.gap, true);
  set(model, place::kLoadDamping, sheet.load_damping, true);
  set(model, place::kLoadCoulombFriction, sheet.load_coulomb, true);
  set(model, place::kContactStiffness, true_drive.contact_stiffness, false);
  set(model, place::kContactDamping, true_drive.contact_damping, false);
  return model;
}

Recording recorded(const independent_plant::BlindCase& c, BlindPlant plant) {
  return plant == BlindPlant::kMujoco ? engine_plant::mujoco_recording(c)
                                      : independent_plant::simulate_blind(c).recording;
}

}  // namespace

BlindPair blind_pair(const std::string& rig, const std::string& effect, double severity, std::uint64_t seed) {
  return blind_pair(rig, effect == "none" ? std::vector<std::string>{} : std::vector{effect}, severity, seed);
}

BlindPair blind_pair(const std::string& rig, const std::vector<std::string>& effects, double severity,
                     std::uint64_t seed, double duration, BlindPlant plant) {
  auto g = random_stream(seed, "diagnosis excitation");
  independent_plant::BlindCase c = rig_case(rig);
  c.options.duration = duration;
  vary(c.drive, seed);
  const auto first = static_cast<std::size_t>(uniform(g, 0.0, kWaveforms.size()));
  const auto other = static_cast<std::size_t>(uniform(g, 1.0, kWaveforms.size()));
  const std::string name = effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, "+"));
  BlindPair pair{rig,
                 name,
                 severity,
                 1.0,
                 "",
                 {},
                 {},
                 {},
                 sheet_model(c.drive, independent_plant::data_sheet(c.drive, seed)),
                 sheet_model(c.drive, c.drive),
                 {}};
  const auto excited = [&](std::size_t kind, std::uint64_t noise) {
    excite(c, kWaveforms[kind % kWaveforms.size()], g);
    c.options.seed = noise;
    pair.excitations += "smwtzj"[kind % kWaveforms.size()];
  };
  excited(first, 2 * seed);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    independent_plant::give_effect(c, effects[i], severity, seed + i * kNextDraw);
    pair.drawn.push_back(drawn_law(c.drive.effects, effects[i]));
  }
  pair.train = recorded(c, plant);
  excited(first + other, 2 * seed + 1);
  pair.held_out = recorded(c, plant);
  excited(static_cast<std::size_t>(uniform(g, 0.0, kWaveforms.size())), ~(2 * seed));
  pair.next = [c, plant] { return recorded(c, plant); };
  if (const auto* drawn = independent_plant::find_drawn_effect(name);
      drawn != nullptr && drawn->traits.cycles_per_turn != nullptr)
    pair.cycles_per_turn = drawn->traits.cycles_per_turn(c);
  return pair;
}

}  // namespace gapscope::blind
