#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gapscope/base/random.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// A two-inertia drive for the tests of the detector only: the paper's rig by default. Motor friction may
/// be Coulomb, Stribeck or presliding (bristle), cogging is locked to the motor angle.
struct TestDrive {
  double m1 = 8.78e-4, m2 = 8.78e-4;      // [kg m²]; m2 = 0: one inertia
  double Km = 0.172;                      // [N m per unit of u]
  double d1 = 0.062, d2 = 0.035;          // [N m s/rad]
  double Fc2 = 0.05;                      // load Coulomb friction [N m]
  double k = 200.0, c = 0.05;             // contact [N m/rad], [N m s/rad]
  double gap = 0.0188;                    // [rad]
  double Fc1 = 0.0, Fs1 = 0.0, vs = 0.1;  // motor Coulomb, breakaway [N m], Stribeck speed [rad/s]
  double bristle = 0.0;                   // presliding stiffness [N m/rad]; 0: none
  double cogging = 0.0, periods = 12.0;   // [N m], [1/rev]
  double x1 = 0.0, x2 = 0.0;              // initial positions [rad]
};

struct TestEncoder {
  double rate = 2500.0;  // [Hz]
  double duration = 10.0;
  int bits = 20;       // 0: no quantisation
  double noise = 0.0;  // rms, in quanta
  std::uint64_t seed = 1;
  double step = 2e-6;  // of the integration [s]
};

struct TestRecording {
  std::vector<double> u, x1;
  std::vector<double> true_x1, true_x2;
  double dt = 0.0;
  double quantum = 0.0;
  MotorTrace trace(const std::string& file = "test.csv") const { return {file, 0.0, dt, u, x1, quantum}; }
};

struct TestState {
  double x1, w1, x2, w2, z;
};

inline double soft(double value, double threshold) {
  return std::copysign(std::fmax(std::fabs(value) - threshold, 0.0), value);
}

/// One semi-implicit step: velocities first, dry friction as a set-valued projection, then positions.
inline void integrate(TestState& s, const TestDrive& p, double torque, double h) {
  const double delta = s.x1 - s.x2;
  const double depth = std::fabs(delta) - 0.5 * p.gap;
  double contact = 0.0;
  if (p.m2 > 0.0 && depth > 0.0) {
    const double side = delta > 0.0 ? 1.0 : -1.0;
    contact = side * std::fmax(p.k * depth + p.c * side * (s.w1 - s.w2), 0.0);
  }
  double motor = torque - p.d1 * s.w1 - contact;
  if (p.cogging != 0.0) motor -= p.cogging * std::sin(p.periods * s.x1);
  const double level = p.Fc1 + (p.Fs1 > p.Fc1 ? (p.Fs1 - p.Fc1) * std::exp(-std::pow(s.w1 / p.vs, 2)) : 0.0);
  if (p.bristle > 0.0) {
    const double rate = s.w1 - std::fabs(s.w1) * p.bristle * s.z / std::fmax(level, 1e-12);
    s.z += h * rate;
    motor -= p.bristle * s.z + 0.02 * rate;
  }
  s.w1 += h * motor / p.m1;
  if (p.bristle <= 0.0) s.w1 = soft(s.w1, h * level / p.m1);
  s.x1 += h * s.w1;
  if (p.m2 <= 0.0) return;
  s.w2 = soft(s.w2 + h * (contact - p.d2 * s.w2) / p.m2, h * p.Fc2 / p.m2);
  s.x2 += h * s.w2;
}

/// What the encoder reads while input(t) drives: read at the sample, u held until the next.
inline TestRecording record(const TestDrive& drive, const std::function<double(double)>& input,
                            const TestEncoder& encoder) {
  TestRecording r;
  r.dt = 1.0 / encoder.rate;
  r.quantum = encoder.bits > 0 ? 2.0 * 3.14159265358979323846 / std::ldexp(1.0, encoder.bits) : 0.0;
  const auto n = static_cast<std::size_t>(encoder.duration * encoder.rate);
  const int inner = static_cast<int>(std::ceil(r.dt / encoder.step));
  auto generator = random_stream(encoder.seed, "test encoder");
  const double offset = uniform(generator, 0.0, 1.0);
  TestState s{drive.x1, 0.0, drive.x2, 0.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const double u = input(r.dt * static_cast<double>(i));
    const double noise = encoder.noise > 0.0 ? encoder.noise * r.quantum * normal(generator) : 0.0;
    r.u.push_back(u);
    r.x1.push_back(r.quantum > 0.0 ? r.quantum * std::floor((s.x1 + noise) / r.quantum + offset) : s.x1);
    r.true_x1.push_back(s.x1);
    r.true_x2.push_back(s.x2);
    for (int j = 0; j < inner; ++j) integrate(s, drive, drive.Km * u, r.dt / inner);
  }
  return r;
}

inline std::function<double(double)> sine(double amplitude, double frequency) {
  return [=](double t) { return amplitude * std::sin(2.0 * 3.14159265358979323846 * frequency * t); };
}

/// The source paper's experiment: 1 Hz, 0.1 N m, 20 bit.
inline TestRecording paper_experiment(std::uint64_t seed = 1, double noise = 0.0, double gap = 0.0188) {
  TestDrive drive;
  drive.gap = gap;
  TestEncoder encoder;
  encoder.seed = seed;
  encoder.noise = noise;
  return record(drive, sine(0.5814, 1.0), encoder);
}

}  // namespace gapscope
