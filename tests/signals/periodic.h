#pragma once

#include <cmath>
#include <vector>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"

namespace gapscope::testing {

/// Two harmonics with a period that is no whole number of samples, read through a coarse and noisy encoder.
struct Periodic {
  double period = 0.7313, dt = 1e-3, quantum = 1e-3, noise = 0.0;
  std::vector<double> u, x1;

  double truth(double t) const {
    const double phase = 2.0 * kPi * t / period;
    return 0.1 * std::sin(phase) + 0.02 * std::cos(3.0 * phase);
  }
  MotorTrace trace(double seconds, double drift = 0.0) {
    auto generator = random_stream(1, "periodic");
    for (int i = 0; i * dt < seconds; ++i) {
      const double t = i * dt, x = truth(t) + drift * t + noise * normal(generator);
      u.push_back(std::sin(2.0 * kPi * t / period));
      x1.push_back(quantum > 0.0 ? quantum * std::round(x / quantum) : x);
    }
    return {"periodic.csv", 0.0, dt, u, x1, quantum};
  }
};

}  // namespace gapscope::testing
