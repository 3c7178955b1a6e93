#include "diagnosis/loop_cases.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "diagnosis/loop_bench.h"
#include "torque_view/band.h"

namespace gapscope::test {
namespace {

using namespace independent_plant;
namespace torque_view = internal::torque_view;

constexpr double kWindow = 0.02;              ///< over which momentum is balanced [s]
constexpr double kLeast = -1.0, kMost = 1.5;  ///< severity
constexpr int kHalvings = 7;
constexpr double kStandsStill = 0.1;  ///< of the travel without the effect: less is no recording of a motion
constexpr int kMostDraws = 20;        ///< of a drive that moves
constexpr double kVoltStep = 0.01;    ///< in which the supply is read [-]

/// The firmware's law as its user would declare it.
DriveController declared_controller(const ControllerSettings& s) {
  DriveController c;
  c.kind = s.filter_s > 0.0 ? ControllerKind::kPosition : ControllerKind::kCascade;
  c.gain = s.position_gain, c.speed_gain = s.speed_gain;  // of a P alone the latter is 1
  c.delay = s.dead_time_s, c.saturation = s.limit;
  return c;
}

/// What such a servo tells: target, position and volts; u is made of them.
Recording commanded(const Bench& b, const Session& session, double volt_step) {
  LoopRun loop = in_loop(b, session);
  auto rows = std::make_shared<CommandRows>();
  rows->t = loop.stamps, rows->position = loop.run.recording.x1;
  for (const Target& target : loop.target) rows->target.push_back(target.x);
  for (const double v : loop.supply) rows->supply.push_back(volt_step * std::round(v / volt_step));
  Recording r = loop.run.recording;
  r.command = rows;
  command_by(declared_controller(b.controller), r);
  return r;
}

/// The true motion as a perfect encoder that runs out of centre tells it.
struct Seen {
  double x, w;
};
Seen seen(const BlindDrive& d, const BlindTruth& truth, std::size_t k) {
  const SensorEffects& e = d.effects.sensor;
  const double angle = truth.x1[k] + e.eccentricity_phase_rad;
  return {truth.x1[k] + e.eccentricity_rad * std::sin(angle),
          truth.w1[k] * (1.0 + e.eccentricity_rad * std::cos(angle))};
}

/// Rows of Km ∫u dt = J Δw + d Δx (+ c ∫dt), on the true motion over windows.
struct Balance {
  Eigen::MatrixXd g;
  Eigen::VectorXd pushed;
};

Balance balance_of(const Bench& b, const BlindRun& run) {
  const double dt = run.recording.dt;
  const auto step = static_cast<std::size_t>(std::ceil(kWindow / dt));
  const std::size_t count = (run.truth.x1.size() - 1) / step;
  Balance rows{Eigen::MatrixXd(count, 3), Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count))};
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const std::size_t from = i * step, to = from + step;
    for (std::size_t k = from; k < to; ++k)
      rows.pushed[row] += b.c.drive.torque_constant * run.recording.u[k] * dt;
    const Seen last = seen(b.c.drive, run.truth, to), first = seen(b.c.drive, run.truth, from);
    rows.g.row(row) << last.w - first.w, last.x - first.x,
        b.driven == Driven::kConstantSpeed ? dt * static_cast<double>(step) : 0.0;
  }
  return rows;
}

double missing_share(const Bench& b) {
  const Balance train = balance_of(b, recorded(b, b.train)), held = balance_of(b, recorded(b, b.held_out));
  Eigen::Vector3d theta = train.g.completeOrthogonalDecomposition().solve(train.pushed);
  Eigen::VectorXd left = held.pushed - held.g * theta;
  if (b.driven == Driven::kConstantSpeed) left.array() -= left.mean();  // each recording has its own level
  return left.norm() / held.pushed.norm();
}

/// Gives the effect at the severity that makes the share, or comes nearest.
double give_to_size(Bench& b, const std::string& effect, double share) {
  const Bench without = b;
  BlindCase bare = b.c;
  const double period = 2.0 * b.train.motion.travel / std::abs(b.train.motion.speed);
  const MotionScale scale = scale_of_motion(
      bare, recorded(b, b.train), b.driven == Driven::kOpen ? 1.0 / b.train.excitation.frequency : period);
  double low = kLeast, high = kMost, missing = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double severity = 0.5 * (low + high);
    b.c = without.c;
    give_effect(b.c, effect, severity, b.train.seed, scale);
    missing = missing_share(b);
    (missing > share ? high : low) = severity;
  }
  return missing;
}

/// The least travel in either recording [rad].
double least_travel(const Bench& b) {
  double least = kInfinity;
  for (const Session* session : {&b.train, &b.held_out}) {
    const std::vector<double> x1 = recorded(b, *session).truth.x1;
    const auto [low, high] = std::minmax_element(x1.begin(), x1.end());
    least = std::min(least, *high - *low);
  }
  return least;
}

ReferenceModel sheet_of(std::mt19937_64& g, const BlindDrive& d) {
  ReferenceModel sheet;
  sheet.structure.has_load = false;
  const double inertia = d.motor_inertia * uniform(g, 0.7, 1.3),
               damping = d.motor_damping * uniform(g, 0.7, 1.3);
  sheet.parameters[place::kMotorInertia] = {inertia, true, kNaN, kNaN, {}};
  sheet.parameters[place::kTorqueConstant].value = d.torque_constant;
  sheet.parameters[place::kMotorDamping] = {damping, true, kNaN, kNaN, {}};
  return sheet;
}

/// A current that is measured has gone through them: nothing is missing then.
bool acts_before_the_current(const std::string& effect) {
  return effect == "input_delay" || effect == "input_dead_zone" || effect == "torque_saturation";
}

constexpr double kFewestShown = 0.1;   ///< of the held-out torque, by what is looked for
constexpr double kMostAtLimit = 0.02;  ///< of the samples: a loop that is stable reaches it now and then

/// The band of the torque balance of a drive as it is.
double band_of(const Bench& b) {
  const torque_view::StampedTrace traces[] = {
      torque_view::stamped(recorded(b, b.train).recording.motor_trace(), true)};
  return torque_view::choose_band(traces, {}, {}).hz;
}

/// Hangs a part of the inertia on a spring. @returns its frequency and share, in words
std::string hang_on_spring(std::mt19937_64& g, Bench& b) {
  const double hz = log_uniform(g, 0.3, 1.0) * band_of(b);
  BlindDrive& d = b.c.drive;
  const double whole = d.motor_inertia, damping = d.motor_damping, share = uniform(g, 0.3, 0.75);
  const double omega = 2.0 * kPi * hz, ratio = log_uniform(g, 0.02, 0.2);
  d.load = BlindLoad::kFree, d.contact = ContactKind::kBonded, d.gap = 0.0;
  d.motor_inertia = (1.0 - share) * whole, d.load_inertia = share * whole;
  d.motor_damping = d.load_damping = 0.5 * damping;
  d.contact_stiffness = d.load_inertia * omega * omega;
  d.contact_damping = 2.0 * ratio * d.load_inertia * omega;
  const double level = damping * b.train.motion.speed;  // viscous friction at the top speed
  d.load_coulomb = uniform(g, 0.0, 1.0) < 0.5 ? uniform(g, 0.2, 1.0) * level : 0.0;
  if (uniform(g, 0.0, 1.0) < 0.5) d.effects.motor.friction.level_nm = uniform(g, 0.2, 1.0) * level;
  return fmt::format("{:.0f} % of the inertia behind {:.1f} Hz, damping {:.2g}, friction {:.2g} + {:.2g} N m",
                     100.0 * share, hz, ratio, d.effects.motor.friction.level_nm, d.load_coulomb);
}

bool is_shaken(const Bench& b) {
  const std::vector<double> u = recorded(b, b.train).recording.u;
  const auto at_limit =
      std::count_if(u.begin(), u.end(), [&](double v) { return std::abs(v) > 0.999 * b.controller.limit; });
  return static_cast<double>(at_limit) > kMostAtLimit * static_cast<double>(u.size());
}

/// What a spring leaves of the held-out torque, beside friction at either body that is told.
double missing_beside_friction(const Bench& b) {
  Bench smooth = b;
  smooth.c.drive.load_coulomb = smooth.c.drive.effects.motor.friction.level_nm = 0.0;
  return missing_share(smooth);
}

}  // namespace

const std::vector<std::string>& loop_effects(Driven driven) {
  static const std::vector<std::string> all = {
      "motor_coulomb_friction", "stribeck_friction", "presliding_friction",   "friction_asymmetry",
      "quadratic_drag",         "load_unbalance",    "constant_load_torque",  "cogging_torque",
      "torque_ripple",          "input_delay",       "input_dead_zone",       "torque_saturation",
      "encoder_eccentricity",   "viscous_drift",     "load_inertia_variation"};
  static const std::vector<std::string> lines = {"cogging_torque", "torque_ripple"};
  if (driven == Driven::kLevels) return lines;
  static const std::vector<std::string> periodic = {"cogging_torque", "load_unbalance", "torque_ripple",
                                                    "encoder_eccentricity"};
  return driven == Driven::kConstantSpeed ? periodic : all;
}

LoopCase loop_case(Driven driven, const std::string& effect, std::uint64_t seed, double volt_step) {
  std::mt19937_64 g = random_stream(seed, "closed loop study");
  LoopCase result;
  result.seed = seed, result.effect = effect;
  Bench b;
  for (; result.redrawn < kMostDraws; ++result.redrawn) {
    b = drawn_bench(g, driven, seed);
    if (acts_before_the_current(effect)) b.recorder.input = RecordedInput::kCommand;
    const double share = log_uniform(g, 0.1, 0.6), travel = least_travel(b);
    result.sheet = sheet_of(g, b.c.drive);
    result.missing = effect == "none" ? missing_share(b) : give_to_size(b, effect, share);
    if (least_travel(b) > kStandsStill * travel) break;
  }
  result.set_up = in_words(b);
  result.drive = b.c.drive;
  const bool servo = driven == Driven::kCommanded;
  result.train = servo ? commanded(b, b.train, volt_step) : recorded(b, b.train).recording;
  result.held_out = servo ? commanded(b, b.held_out, volt_step) : recorded(b, b.held_out).recording;
  if (servo) result.controller = declared_controller(b.controller);
  return result;
}

LoopCase belt_case(std::uint64_t seed) {
  std::mt19937_64 g = random_stream(seed, "belt study");
  LoopCase result;
  result.seed = seed, result.effect = "load_resonance";
  Bench b;
  std::string spring;
  for (; result.redrawn < kMostDraws; ++result.redrawn) {
    b = drawn_bench(g, Driven::kLoop, seed);
    result.sheet = sheet_of(g, b.c.drive);
    spring = hang_on_spring(g, b);
    if (!is_shaken(b) && missing_beside_friction(b) > kFewestShown) break;
  }
  result.missing = missing_share(b);
  result.set_up = in_words(b) + ", " + spring;
  result.drive = b.c.drive;
  result.spring_hz = std::sqrt(b.c.drive.contact_stiffness / b.c.drive.load_inertia) / (2.0 * kPi);
  result.train = recorded(b, b.train).recording, result.held_out = recorded(b, b.held_out).recording;
  return result;
}

LoopCase level_case(const std::string& effect, std::uint64_t seed) {
  std::mt19937_64 g = random_stream(seed, "speed levels study");
  LoopCase result;
  result.seed = seed, result.effect = effect;
  Bench b = drawn_bench(g, Driven::kLevels, seed);
  if (effect == "torque_ripple") b.recorder.input = RecordedInput::kCommand;
  if (uniform(g, 0.0, 1.0) < 0.5) {
    const double share = uniform(g, 0.2, 1.0);  // of the viscous friction at the top speed
    b.c.drive.effects.motor.friction.level_nm = share * b.c.drive.motor_damping * b.train.motion.speed;
  }
  const Recording bare = recorded(b, b.train).recording;
  const double band = band_of(b);
  const double hz = log_uniform(g, 0.3, 3.0) * band;
  result.periods = std::max(2.0, std::round(2.0 * kPi * hz / b.train.motion.speed));
  const double input = rms(bare.u) * b.c.drive.torque_constant;
  const AngleHarmonic line{log_uniform(g, 0.05, effect == "torque_ripple" ? 0.3 : 0.5), result.periods,
                           uniform(g, 0.0, 2.0 * kPi)};
  result.amplitude = effect == "torque_ripple" ? line.amplitude : input * line.amplitude;
  (effect == "torque_ripple" ? b.c.drive.effects.command.ripple : b.c.drive.effects.motor.cogging) = line;
  b.c.drive.effects.motor.cogging.amplitude *= input;
  result.sheet = sheet_of(g, b.c.drive);
  result.missing = missing_share(b);
  result.set_up = fmt::format("{}, {} levels, {:.0f} per turn pass at {:.2f} times {:.1f} Hz", in_words(b),
                              b.train.motion.levels, result.periods,
                              result.periods * b.train.motion.speed / (2.0 * kPi * band), band);
  result.drive = b.c.drive;
  result.train = recorded(b, b.train).recording, result.held_out = recorded(b, b.held_out).recording;
  return result;
}

}  // namespace gapscope::test
