#include "diagnosis/loop_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"

namespace gapscope::test {
namespace {

using namespace independent_plant;

constexpr double kDuration = 8.0;  ///< of a recording [s]

struct EncoderAndRate {
  int bits;
  double rate;
};
constexpr std::array<EncoderAndRate, 4> kElectronics{{{12, 200.0}, {14, 500.0}, {16, 1000.0}, {20, 2000.0}}};
constexpr std::array<EncoderAndRate, 5> kServos{
    {{12, 100.0}, {12, 200.0}, {14, 200.0}, {14, 500.0}, {16, 500.0}}};
constexpr std::array<EncoderAndRate, 3> kFine{{{14, 500.0}, {16, 1000.0}, {20, 2000.0}}};
constexpr std::array kCourses{Course::kSCurve, Course::kTriangle, Course::kTrapezoid, Course::kSines,
                              Course::kPickAndPlace};
constexpr std::array kCourseNames{"constant", "S", "triangle", "trapezoid", "sines", "places", "levels"};
constexpr std::array kWaveforms{Waveform::kMultisine, Waveform::kSweptSine, Waveform::kTrapezoid,
                                Waveform::kSteps};
constexpr std::array kWaveformNames{"sine", "multisine", "sweep", "triangle", "trapezoid", "steps"};

template <class Array>
auto pick(std::mt19937_64& g, const Array& values) {
  return values[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(values.size())))];
}

void draw_motion(std::mt19937_64& g, Driven driven, ReferenceMotion& m) {
  m.course = driven == Driven::kConstantSpeed ? Course::kConstantSpeed
             : driven == Driven::kLevels      ? Course::kLevels
                                              : pick(g, kCourses);
  m.speed = log_uniform(g, 3.0, 15.0);
  m.travel = m.speed * log_uniform(g, 0.4, 2.0);
  m.dwell_s = uniform(g, 0.0, 0.3);
  if (driven == Driven::kLevels) {
    m.travel = m.speed * log_uniform(g, 0.5, 2.0);
    m.levels = 1 + static_cast<int>(uniform(g, 0.0, 3.0));
  }
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
  const EncoderAndRate electronics = servo                       ? pick(g, kServos)
                                     : driven == Driven::kLevels ? pick(g, kFine)
                                                                 : pick(g, kElectronics);
  c.options = {electronics.rate, kDuration, 0, kFastTolerance};
  const bool noisy = uniform(g, 0.0, 1.0) < 0.5;
  c.sensor = BlindSensor::with_bits(electronics.bits, noisy ? uniform(g, 0.3, 1.0) : 0.0);
}

/// Limit and noise of the current come from what the drive needs without its effect.
void draw_amplifier(std::mt19937_64& g, Bench& b, double peak) {
  b.controller.limit = peak * uniform(g, 1.0, 3.0);
  if (b.recorder.input == RecordedInput::kCurrent) b.recorder.input_noise = peak * uniform(g, 0.002, 0.01);
}

}  // namespace

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

}  // namespace gapscope::test
