#pragma once

#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::test {

/// The rig of the source paper's experiment (Sections III-D and IV) with a contact of 200 N m/rad.
inline DriveParameters<double> paper_rig() {
  return {8.78e-4, 0.172, 0.062, 1.0, 0.0188, 0.035, 0.05, 200.0, 0.05};
}

/// A geared axis: three times the inertia behind the gap, softer contact.
inline DriveParameters<double> geared_axis() {
  return {2e-4, 0.05, 0.004, 3.0, 0.03, 0.003, 0.008, 60.0, 0.01};
}

/// A heavy load behind a small gap.
inline DriveParameters<double> heavy_load() { return {1e-3, 0.5, 0.05, 8.0, 0.006, 0.06, 0.03, 1500.0, 0.2}; }

inline std::vector<double> sine(double amplitude, double frequency, double rate, double duration) {
  std::vector<double> u(static_cast<std::size_t>(std::lround(rate * duration)));
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = amplitude * std::sin(2.0 * kPi * frequency * static_cast<double>(i) / rate);
  return u;
}

/// Several incommensurate lines: impacts of every strength.
inline std::vector<double> several_sines(double amplitude, double rate, double duration) {
  std::vector<double> u(static_cast<std::size_t>(std::lround(rate * duration)));
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double t = static_cast<double>(i) / rate;
    for (const double f : {0.37, 0.91, 1.73, 3.1, 5.3, 7.7})
      u[i] += amplitude / 3.0 * std::sin(2.0 * kPi * f * t + 5.0 * f);
  }
  return u;
}

/// Each input `times` times: the same torque at a finer sampling.
inline std::vector<double> held(const std::vector<double>& u, int times) {
  std::vector<double> fine;
  fine.reserve(u.size() * static_cast<std::size_t>(times));
  for (const double v : u) fine.insert(fine.end(), static_cast<std::size_t>(times), v);
  return fine;
}

}  // namespace gapscope::test
