// Is a controller's gain found from target and position alone, where a known mass gives the scale, and is it
// said with what it is confounded where nothing does? Random servos of the independent plant under its own
// cascade of P and P. study_controller [first seed] [number of drives] [anchored|free] [verbose]
// And a real servo with a pendulum: study_controller xl330 FOLDER
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "base/random.h"
#include "drives/closed_loop.h"
#include "gapscope/base/statistics.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;
namespace at = controller_place;

/// A servo of one inertia with dry friction and an arm, and the loop that holds it.
struct Servo {
  independent_plant::BlindDrive drive;
  independent_plant::ControllerSettings controller;
  independent_plant::ReferenceMotion motion;
  independent_plant::BlindSensor sensor;
  std::uint64_t seed = 1;
};

Servo drawn_servo(std::uint64_t seed, bool anchored) {
  auto g = random_stream(seed, "controller study");
  Servo s;
  s.seed = seed;
  s.motion = {.course = independent_plant::Course::kSines,
              .travel = uniform(g, 1.0, 3.0),
              .speed = uniform(g, 3.0, 8.0)};
  independent_plant::BlindDrive& d = s.drive;
  d.load = independent_plant::BlindLoad::kNone;
  d.motor_inertia = log_uniform(g, 2e-4, 5e-3);
  d.torque_constant = log_uniform(g, 0.05, 1.0);
  d.motor_damping = d.motor_inertia * log_uniform(g, 0.5, 5.0);
  const double acceleration = s.motion.speed * s.motion.speed / s.motion.travel;
  const double torque = d.motor_inertia * acceleration;
  d.effects.motor.friction.level_nm = torque * log_uniform(g, 0.02, 0.3);
  const double gravity = torque * log_uniform(g, 0.3, 3.0);
  if (anchored) d.effects.load.unbalance_nm = gravity;
  const double rate = std::array{100.0, 200.0, 500.0}[seed % 3], omega = 2.0 * kPi * uniform(g, 2.0, 6.0);
  s.controller = {.rate = rate,
                  .position_gain = 0.25 * omega,
                  .speed_forward = 0.0,
                  .speed_gain = omega * d.motor_inertia / d.torque_constant,
                  .dead_time_s = uniform(g, 0.2, 1.0) / rate};
  s.sensor = independent_plant::BlindSensor::with_bits(std::array{12, 14, 16}[seed / 3 % 3]);
  return s;
}

Recording commanded_recording(const Servo& s) {
  const independent_plant::LoopRun loop =
      simulate_closed_loop(s.drive, s.motion, s.controller, s.sensor, {},
                           {.duration = 8.0, .seed = s.seed, .tolerance = independent_plant::kFastTolerance});
  auto rows = std::make_shared<CommandRows>();
  rows->t = loop.stamps, rows->position = loop.run.recording.x1;
  for (const auto& target : loop.target) rows->target.push_back(target.x);
  rows->supply.assign(rows->t.size(), 1.0);
  Recording r = loop.run.recording;
  r.u.assign(r.size(), kNaN);
  r.x2.clear(), r.mode.clear();
  r.command = rows;
  return r;
}

ModelEffect effect(const char* name, std::initializer_list<ParameterSetting> settings) {
  ModelEffect e{find_effect(name), {}};
  std::copy(settings.begin(), settings.end(), e.parameters.begin());
  return e;
}

/// Everything is looked for but the torque constant, the gain of the position and the mass.
ReferenceModel servo_model(const Servo& s, std::uint64_t seed) {
  auto g = random_stream(seed, "controller starts");
  ReferenceModel model = known_model(s.drive);
  model.structure.has_load = false;
  estimate(model, kMotorInertia, s.drive.motor_inertia * log_uniform(g, 0.5, 2.0));
  estimate(model, kMotorDamping, s.drive.motor_damping * log_uniform(g, 0.5, 2.0));
  model.effects.push_back(
      effect("motor_coulomb_friction",
             {ParameterSetting::sought(s.drive.effects.motor.friction.level_nm * log_uniform(g, 0.5, 2.0))}));
  if (const double arm = s.drive.effects.load.unbalance_nm; arm > 0.0)
    model.effects.push_back(
        effect("load_unbalance",
               {ParameterSetting::known(arm), ParameterSetting::known(0.0), ParameterSetting::known(1.0)}));
  ControllerModel& c = model.controller.emplace();
  c.fixed.kind = ControllerKind::kCascade, c.fixed.rate = s.controller.rate;
  for (ParameterSetting& number : c.numbers) number.value = 0.0;
  c.numbers[at::kGain].value = s.controller.position_gain;
  c.numbers[at::kSpeedGain] = ParameterSetting::sought();
  c.numbers[at::kDelay] = ParameterSetting::sought(0.5 / s.controller.rate);
  return model;
}

/// Whether one warning says of both that they change together.
bool named(const FitSummary& summary, const std::string& key, const std::string& other) {
  for (const Remark& w : summary.warnings)
    if (w.text().find(key) != std::string::npos && w.text().find(other) != std::string::npos &&
        w.text().find("change together") != std::string::npos)
      return true;
  return false;
}

struct Tally {
  int told = 0, held = 0;
  std::vector<double> errors;  ///< relative
};

void count(const FitSummary& found, const std::map<std::string, double>& truth,
           std::map<std::string, Tally>& tallies, bool verbose) {
  for (const auto& [key, is] : truth) {
    const FittedParameter* p = found.find(key);
    Tally& t = tallies[key];
    t.told += p->identifiable && !found.rejected();
    t.held += !found.rejected() && contains(found, key.c_str(), is);
    t.errors.push_back(std::abs(p->value / is - 1.0));
    if (verbose)
      fmt::print("  {} {:+.2f}% ({:+.1f}s)", key, 100.0 * (p->value / is - 1.0), (p->value - is) / p->std);
  }
}

void print(const std::map<std::string, Tally>& tallies) {
  for (const auto& [key, t] : tallies) {
    const Interval share = wilson(t.held, t.told);
    fmt::print("{:<32} told {} held {} = {:.1f} % [{:.1f}, {:.1f}], error median {:.3f} %, 95 % {:.2f} %\n",
               key, t.told, t.held, 100.0 * t.held / std::max(t.told, 1), 100.0 * share.low,
               100.0 * share.high, 100.0 * median(t.errors), 100.0 * quantile(t.errors, 0.95));
  }
}

/// A servo as it was recorded: duty, a register without its sign, and the voltage of the supply.
Recording recorded_servo(const std::string& path, bool by_target) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  Recording r;
  r.file = path.substr(path.rfind('/') + 1);
  auto rows = std::make_shared<CommandRows>();
  for (double t, goal, x, duty, volts; std::getline(in, line);) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &t, &goal, &x, &duty, &volts) != 5) continue;
    rows->t.push_back(t), rows->target.push_back(goal), rows->position.push_back(x);
    rows->supply.push_back(volts);
    r.u.push_back((duty > 32767 ? duty - 65536 : duty) / 885.0 * volts);
  }
  r.x1 = rows->position, r.stamps = rows->t;
  r.start = r.stamps.front();
  r.dt = (r.stamps.back() - r.start) / static_cast<double>(r.size() - 1);
  r.quantum = 2.0 * kPi / 4096.0;
  if (by_target) r.command = rows;
  return r;
}

constexpr double kMass = 0.49, kArm = 0.1;  // of the pendulum [kg], [m]

/// What `anchor: {mass: 0.49, arm: 0.1}` makes of a servo with friction that grows with its load.
ReferenceModel anchored_servo() {
  ReferenceModel model;
  model.structure.has_load = false;
  estimate(model, kMotorInertia, 1.5 * kMass * kArm * kArm);
  estimate(model, kMotorDamping, 0.04);
  estimate(model, kTorqueConstant, 0.1);
  model.parameters[kMotorInertia].low = kMass * kArm * kArm, model.parameters[kMotorInertia].high = 0.49;
  ParameterSetting phase = ParameterSetting::sought(0.0);
  phase.low = -0.5, phase.high = 0.5;
  model.effects = {
      effect("load_dependent_friction", {ParameterSetting::sought(0.01), ParameterSetting::sought(0.1)}),
      effect("load_unbalance",
             {ParameterSetting::known(kMass * 9.80665 * kArm), phase, ParameterSetting::known(1.0)})};
  return model;
}

FitSummary fit_servo(const std::string& folder, const std::string& kp, const ReferenceModel& model) {
  std::vector<Recording> recordings;
  for (const char* motion : {"sin_sin", "sin_time_square", "up_and_down"})
    recordings.push_back(
        recorded_servo(folder + "/" + motion + "_kp" + kp + ".csv", model.controller.has_value()));
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return fit(traces, model);
}

/// The torque constant from duty times volts, then the gain from target and position with that constant.
void real_servo(const std::string& folder) {
  for (const char* kp : {"400", "100"}) {
    const FitSummary by_duty = fit_servo(folder, kp, anchored_servo());
    fmt::print("kp {} from duty x volts\n{}\n", kp, by_duty.full_report());
    ReferenceModel model = anchored_servo();
    model.parameters[kTorqueConstant] = ParameterSetting::known(by_duty.find("torque_constant")->value);
    ControllerModel& c = model.controller.emplace();
    for (ParameterSetting& number : c.numbers) number.value = 0.0;
    c.numbers[at::kGain] = ParameterSetting::sought();
    c.fixed.saturation = 1.0;
    fmt::print("kp {} from target, the gain withheld\n{}\n", kp, fit_servo(folder, kp, model).full_report());
    std::fflush(stdout);
  }
}

int main_study(int argc, char** argv) {
  if (argc > 2 && std::string(argv[1]) == "xl330") {
    real_servo(argv[2]);
    return 0;
  }
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int drives = argc > 2 ? std::atoi(argv[2]) : 30;
  const bool anchored = argc <= 3 || std::string(argv[3]) != "free", verbose = argc > 4;
  std::map<std::string, Tally> tallies, of_good;
  std::map<std::string, int> trusts;
  int confounded = 0;
  for (int i = 0; i < drives; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const Servo s = drawn_servo(seed, anchored);
    const FitSummary found = fit_one(commanded_recording(s), servo_model(s, seed));
    ++trusts[to_string(found.trust)];
    const bool told = named(found, "controller.velocity.gain", "motor_coulomb_friction");
    confounded += told;
    if (verbose) fmt::print("{} {}", seed, to_string(found.trust));
    const std::map<std::string, double> truth = {
        {"controller.velocity.gain", s.controller.speed_gain},
        {"controller.delay", s.controller.dead_time_s},
        {"motor_inertia", s.drive.motor_inertia},
        {"motor_damping", s.drive.motor_damping},
        {"motor_coulomb_friction.level_nm", s.drive.effects.motor.friction.level_nm}};
    count(found, truth, tallies, verbose);
    if (found.trust == FitTrust::kGood) count(found, truth, of_good, false);
    if (verbose) fmt::print("{}\n", told ? "  confounded" : "");
    std::fflush(stdout);
  }
  for (const auto& [trust, n] : trusts) fmt::print("{} {}\n", trust, n);
  const Interval told = wilson(confounded, drives);
  fmt::print("gain said to be confounded with friction {} of {} [{:.1f}, {:.1f}]\n", confounded, drives,
             100.0 * told.low, 100.0 * told.high);
  print(tallies);
  fmt::print("of those whose trust is good\n");
  print(of_good);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }
