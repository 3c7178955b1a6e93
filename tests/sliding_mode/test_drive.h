#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
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

/// One semi-implicit step of h [s]: velocities first, dry friction as a set-valued projection, then
/// positions.
void integrate(TestState& s, const TestDrive& p, double torque, double h);

/// What the encoder reads while input(t) drives: read at the sample, u held until the next.
TestRecording record(const TestDrive& drive, const std::function<double(double)>& input,
                     const TestEncoder& encoder);

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
