#include "diagnosis/loop_cases.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "gapscope/base/random.h"
#include "independent_plant/closed_loop.h"
#include "independent_plant/severity.h"

namespace gapscope::test {
namespace {

using namespace independent_plant;

constexpr double kDuration = 8.0;             ///< of a recording [s]
constexpr double kWindow = 0.02;              ///< over which momentum is balanced [s]
constexpr double kLeast = -1.0, kMost = 1.5;  ///< severity
constexpr int kHalvings = 7;

struct EncoderAndRate {
  int bits;
  double rate;
};
constexpr std::array<EncoderAndRate, 4> kElectronics{{{12, 200.0}, {14, 500.0}, {16, 1000.0}, {20, 2000.0}}};
constexpr std::array<EncoderAndRate, 5> kServos{
    {{12, 100.0}, {12, 200.0}, {14, 200.0}, {14, 500.0}, {16, 500.0}}};
constexpr double kVoltStep = 0.01;  ///< in which the supply is read [-]
constexpr std::array kCourses{Course::kSCurve, Course::kTriangle, Course::kTrapezoid, Course::kSines,
                              Course::kPickAndPlace};
constexpr std::array kCourseNames{"constant", "S", "triangle", "trapezoid", "sines", "places"};
constexpr std::array kWaveforms{Waveform::kMultisine, Waveform::kSweptSine, Waveform::kTrapezoid,
                                Waveform::kSteps};
constexpr std::array kWaveformNames{"sine", "multisine", "sweep", "triangle", "trapezoid", "steps"};

template <class Array>
auto pick(std::mt19937_64& g, const Array& values) {
  return values[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(values.size())))];
}

/// How one recording of a drive is made.
struct Session {
  ReferenceMotion motion;
  BlindExcitation excitation;
  std::uint64_t seed = 0;
};

struct Bench {
  Driven driven = Driven::kLoop;
  BlindCase c;
  ControllerSettings controller;
  LoopRecorder recorder;
  Session train, held_out;
};

LoopRun in_loop(const Bench& b, const Session& session) {
  BlindOptions options = b.c.options;
  options.seed = session.seed;
  return simulate_closed_loop(b.c.drive, session.motion, b.controller, b.c.sensor, b.recorder, options);
}

BlindRun recorded(const Bench& b, const Session& session) {
  if (b.driven != Driven::kOpen) return in_loop(b, session).run;
  BlindOptions options = b.c.options;
  options.seed = session.seed;
  return simulate_blind(b.c.drive, session.excitation, b.c.sensor, options);
}

/// The firmware's law as its user would declare it.
DriveController declared_controller(const ControllerSettings& s) {
  DriveController c;
  c.kind = s.filter_s > 0.0 ? ControllerKind::kPosition : ControllerKind::kCascade;
  c.gain = s.position_gain, c.speed_gain = s.speed_gain;  // of a P alone the latter is 1
  c.delay = s.dead_time_s, c.saturation = s.limit;
  return c;
}

/// What such a servo tells: target, position and volts; u is made of them.
Recording commanded(const Bench& b, const Session& session) {
  LoopRun loop = in_loop(b, session);
  auto rows = std::make_shared<CommandRows>();
  rows->t = loop.stamps, rows->position = loop.run.recording.x1;
  for (const Target& target : loop.target) rows->target.push_back(target.x);
  for (const double v : loop.supply) rows->supply.push_back(kVoltStep * std::round(v / kVoltStep));
  Recording r = loop.run.recording;
  r.command = rows;
  r.u = commanded_input(declared_controller(b.controller), *rows);
  return r;
}

void draw_motion(std::mt19937_64& g, Driven driven, ReferenceMotion& m) {
  m.course = driven == Driven::kConstantSpeed ? Course::kConstantSpeed : pick(g, kCourses);
  m.speed = log_uniform(g, 3.0, 15.0);
  m.travel = m.speed * log_uniform(g, 0.4, 2.0);
  m.dwell_s = uniform(g, 0.0, 0.3);
  if (driven == Driven::kConstantSpeed && uniform(g, 0.0, 1.0) < 0.3) m.speed = -m.speed;
}

/// A command that would hold the speeds of the references.
void draw_command(std::mt19937_64& g, const BlindDrive& d, BlindExcitation& e) {
  e.waveform = pick(g, kWaveforms);
  e.frequency = log_uniform(g, 0.3, 1.0);
  e.frequency_end = log_uniform(g, 3.0, 8.0);
  const double speed = log_uniform(g, 3.0, 15.0), omega = 2.0 * kPi * e.frequency;
  e.amplitude = speed * std::hypot(d.motor_damping, omega * d.motor_inertia) / d.torque_constant;
}

void draw_controller(std::mt19937_64& g, Bench& b) {
  const BlindDrive& d = b.c.drive;
  const double rate = b.c.options.rate;
  const double bandwidth = log_uniform(g, 3.0, std::min(20.0, rate / 25.0));
  b.controller = tuned_controller(d.motor_inertia, d.torque_constant, bandwidth, rate);
  const double kind = uniform(g, 0.0, 1.0);
  if (kind < 0.25) b.controller.integral_s = kInfinity;
  if (b.driven == Driven::kConstantSpeed && kind >= 0.25) b.controller.position_gain = 0.0;
  if (uniform(g, 0.0, 1.0) < 0.5) b.controller.dead_time_s = 1.0 / rate;
  b.recorder.lead_s = std::ceil(uniform(g, 0.5, 1.5) * rate) / rate;
  if (uniform(g, 0.0, 1.0) < 0.25) b.recorder.input = RecordedInput::kCurrent;
}

/// A P of the position, with a filter that lets no speed through, or a cascade of two.
void draw_servo(std::mt19937_64& g, Bench& b) {
  const BlindDrive& d = b.c.drive;
  const double rate = b.c.options.rate, time_constant = d.motor_inertia / d.motor_damping;
  ControllerSettings& c = b.controller;
  if (uniform(g, 0.0, 1.0) < 0.5) {
    const double omega = 1.0 / (2.0 * uniform(g, 0.4, 1.2) * time_constant);
    c.speed_gain = 1.0, c.filter_s = 1e12;
    c.position_gain = omega * omega * d.motor_inertia / d.torque_constant;
  } else {
    c = tuned_controller(d.motor_inertia, d.torque_constant, log_uniform(g, 3.0, rate / 25.0), rate);
    c.integral_s = kInfinity, c.filter_s = 0.0;
  }
  c.rate = rate, c.speed_forward = 0.0;
  c.dead_time_s = uniform(g, 0.0, 1.0) / rate;
  c.supply_sag = uniform(g, 0.05, 0.25);
  b.recorder.lead_s = std::ceil(uniform(g, 0.5, 1.5) * rate) / rate;
}

void draw_drive(std::mt19937_64& g, Driven driven, BlindCase& c) {
  c.drive.load = BlindLoad::kNone;
  c.drive.motor_inertia = log_uniform(g, 4e-4, 4e-3);
  const bool servo = driven == Driven::kCommanded;
  c.drive.motor_damping =
      c.drive.motor_inertia / (servo ? log_uniform(g, 0.03, 0.15) : log_uniform(g, 0.1, 2.0));
  const EncoderAndRate electronics = servo ? pick(g, kServos) : pick(g, kElectronics);
  c.options = {electronics.rate, kDuration, 0, kFastTolerance};
  const bool noisy = uniform(g, 0.0, 1.0) < 0.5;
  c.sensor = BlindSensor::with_bits(electronics.bits, noisy ? uniform(g, 0.3, 1.0) : 0.0);
}

/// Limit and noise of the current come from what the drive needs without its effect.
void draw_amplifier(std::mt19937_64& g, Bench& b, double peak) {
  b.controller.limit = peak * uniform(g, 1.0, 3.0);
  if (b.recorder.input == RecordedInput::kCurrent) b.recorder.input_noise = peak * uniform(g, 0.002, 0.01);
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

std::string in_words(const Bench& b) {
  const std::string rate = fmt::format("{:.0f} Hz, quantum {:.2g}, noise {:.2g}", b.c.options.rate,
                                       b.c.sensor.quantum, b.c.sensor.noise);
  if (b.driven == Driven::kOpen)
    return fmt::format("{}, {} / {}", rate,
                       kWaveformNames[static_cast<std::size_t>(b.train.excitation.waveform)],
                       kWaveformNames[static_cast<std::size_t>(b.held_out.excitation.waveform)]);
  return fmt::format("{}, {} {:.1f} rad/s / {} {:.1f} rad/s, kv {:.2g} kx {:.2g}{}{}", rate,
                     kCourseNames[static_cast<std::size_t>(b.train.motion.course)], b.train.motion.speed,
                     kCourseNames[static_cast<std::size_t>(b.held_out.motion.course)],
                     b.held_out.motion.speed, b.controller.speed_gain, b.controller.position_gain,
                     std::isinf(b.controller.integral_s) ? " P" : " PI",
                     b.recorder.input == RecordedInput::kCurrent ? ", current" : "");
}

/// A current that is measured has gone through them: nothing is missing then.
bool acts_before_the_current(const std::string& effect) {
  return effect == "input_delay" || effect == "input_dead_zone" || effect == "torque_saturation";
}

Bench drawn_bench(std::mt19937_64& g, Driven driven, std::uint64_t seed) {
  Bench b;
  b.driven = driven;
  draw_drive(g, driven, b.c);
  driven == Driven::kCommanded ? draw_servo(g, b) : draw_controller(g, b);
  for (Session* session : {&b.train, &b.held_out}) {
    draw_motion(g, driven, session->motion);
    draw_command(g, b.c.drive, session->excitation);
  }
  b.train.seed = seed, b.held_out.seed = ~seed;
  double peak = 0.0;
  for (const double u : recorded(b, b.train).recording.u) peak = std::max(peak, std::abs(u));
  draw_amplifier(g, b, peak);
  return b;
}

}  // namespace

const std::vector<std::string>& loop_effects(Driven driven) {
  static const std::vector<std::string> all = {
      "motor_coulomb_friction", "stribeck_friction", "presliding_friction",   "friction_asymmetry",
      "quadratic_drag",         "load_unbalance",    "constant_load_torque",  "cogging_torque",
      "torque_ripple",          "input_delay",       "input_dead_zone",       "torque_saturation",
      "encoder_eccentricity",   "viscous_drift",     "load_inertia_variation"};
  static const std::vector<std::string> periodic = {"cogging_torque", "load_unbalance", "torque_ripple",
                                                    "encoder_eccentricity"};
  return driven == Driven::kConstantSpeed ? periodic : all;
}

LoopCase loop_case(Driven driven, const std::string& effect, std::uint64_t seed) {
  std::mt19937_64 g = random_stream(seed, "closed loop study");
  Bench b = drawn_bench(g, driven, seed);
  if (acts_before_the_current(effect)) b.recorder.input = RecordedInput::kCommand;
  const double share = log_uniform(g, 0.1, 0.6);
  LoopCase result;
  result.seed = seed, result.effect = effect;
  result.sheet = sheet_of(g, b.c.drive);
  result.missing = effect == "none" ? missing_share(b) : give_to_size(b, effect, share);
  result.set_up = in_words(b);
  result.drive = b.c.drive;
  const bool servo = driven == Driven::kCommanded;
  result.train = servo ? commanded(b, b.train) : recorded(b, b.train).recording;
  result.held_out = servo ? commanded(b, b.held_out) : recorded(b, b.held_out).recording;
  if (servo) result.controller = declared_controller(b.controller);
  return result;
}

}  // namespace gapscope::test
