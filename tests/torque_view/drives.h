#pragma once

#include <cmath>
#include <functional>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "torque_view/regressors.h"

namespace gapscope::internal::torque_view::test {

/// A motion in closed form and what a torque law makes of it.
struct Motion {
  double t = 0.0, x = 0.0, w = 0.0, a = 0.0;
};

constexpr double kInertia = 0.02, kDamping = 0.05;  ///< of the drives below

/// Three incommensurate sines: several turns, speeds up to some 12 rad/s.
inline Motion swing(double t, double phase) {
  Motion m{t, 0.0, 0.0, 0.0};
  const double parts[3][2] = {{3.0, 2.1}, {1.0, 5.3}, {0.1, 17.0}};
  for (const auto& [size, omega] : parts) {
    const double angle = omega * t + phase * omega;
    m.x += size * std::sin(angle), m.w += size * omega * std::cos(angle);
    m.a -= size * omega * omega * std::sin(angle);
  }
  return m;
}

/// u = J a + d w + extra(motion) at 500 Hz ± 30 % of a step, encoder of 14 bit, a little noise on u.
inline StampedTrace recorded(const std::function<double(const Motion&)>& extra, double phase,
                             double noise = 0.01, double seconds = 12.0) {
  std::mt19937_64 generator = random_stream(static_cast<std::uint64_t>(100.0 * phase) + 1, "recorded");
  StampedTrace trace;
  trace.quantum = 2.0 * kPi / 16384.0;
  for (double t = 0.0; t < seconds; t += 0.002 * uniform(generator, 0.7, 1.3)) {
    const Motion m = swing(t, phase);
    trace.t.push_back(t);
    trace.x.push_back(trace.quantum * std::round(m.x / trace.quantum));
    trace.u.push_back(kInertia * m.a + kDamping * m.w + extra(m) + noise * normal(generator));
  }
  return trace;
}

/// A pendulum with Coulomb friction 0.02 and a motor whose torque ripples by 8 % six times a turn, from rest:
///   J a = u (1 + 0.08 sin(6 x + 0.5)) − d w − 0.02 sign(w) − 0.08 sin(x),  J = 0.001, d = 0.004,
/// at 500 Hz for 12 s, seen by an encoder of 14 bit.
inline StampedTrace rippling_pendulum(const std::function<double(double)>& input) {
  constexpr double kStep = 0.002;
  constexpr int kSubsteps = 20, kSamples = 6000;
  StampedTrace trace;
  trace.quantum = 2.0 * kPi / 16384.0;
  trace.held_command = true;
  double x = 0.0, w = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = kStep * i, u = input(t), h = kStep / kSubsteps;
    trace.t.push_back(t), trace.u.push_back(u);
    trace.x.push_back(trace.quantum * std::round(x / trace.quantum));
    for (int k = 0; k < kSubsteps; ++k) {
      const double driving = u * (1.0 + 0.08 * std::sin(6.0 * x + 0.5)) - 0.004 * w - 0.08 * std::sin(x);
      const double next = w + h / 0.001 * driving, friction = h / 0.001 * 0.02;
      w = std::copysign(std::max(0.0, std::abs(next) - friction), next);
      x += h * w;
    }
  }
  return trace;
}

/// A motor (0.001, damping 0.002) whose load (0.0015, damping 0.003, Coulomb friction 0.03) hangs on a spring
/// that lets it swing at 6 Hz beside a motor that is held, damping ratio 0.05; at first it swings by 0.02.
/// Recorded as rippling_pendulum().
inline StampedTrace sprung_load(const std::function<double(double)>& input) {
  constexpr double kStep = 0.002, kMotor = 0.001, kLoad = 0.0015, kOmega = 2.0 * kPi * 6.0;
  constexpr int kSubsteps = 40, kSamples = 6000;
  StampedTrace trace;
  trace.quantum = 2.0 * kPi / 65536.0;
  trace.held_command = true;
  double x = 0.0, w = 0.0, y = 0.02, v = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = kStep * i, u = input(t), h = kStep / kSubsteps;
    trace.t.push_back(t), trace.u.push_back(u);
    trace.x.push_back(trace.quantum * std::round(x / trace.quantum));
    for (int k = 0; k < kSubsteps; ++k) {
      const double shaft = kLoad * (kOmega * kOmega * (x - y) + 0.1 * kOmega * (w - v));
      w += h / kMotor * (u - 0.002 * w - shaft);
      const double next = v + h / kLoad * (shaft - 0.003 * v), friction = h / kLoad * 0.03;
      v = std::copysign(std::max(0.0, std::abs(next) - friction), next);
      x += h * w, y += h * v;
    }
  }
  return trace;
}

/// ± 0.3 at a frequency [Hz].
inline double triangle(double t, double hz) { return 0.6 / kPi * std::asin(std::sin(2.0 * kPi * hz * t)); }

/// Sixteen sines from 0.25 Hz to 4 Hz at phases of a seed, 0.8 at most.
inline std::function<double(double)> multisine(std::uint64_t seed) {
  std::mt19937_64 generator = random_stream(seed, "multisine");
  std::vector<double> phases;
  for (int i = 1; i <= 16; ++i) phases.push_back(uniform(generator, 0.0, 2.0 * kPi));
  return [phases](double t) {
    double u = 0.0;
    for (std::size_t i = 0; i < phases.size(); ++i)
      u += std::sin(0.5 * kPi * static_cast<double>(i + 1) * t + phases[i]);
    return 0.05 * u;
  };
}

}  // namespace gapscope::internal::torque_view::test
