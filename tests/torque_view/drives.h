#pragma once

#include <cmath>
#include <functional>

#include "gapscope/base/random.h"
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

}  // namespace gapscope::internal::torque_view::test
