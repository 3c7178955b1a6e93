// Whether a servo was switched off, by its own motion.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "recording/let_go.h"

namespace gapscope::internal::recording {
namespace {

/// An arm with 0.49 kg on 0.1 m under a proportional controller [N m/rad], lifted towards 1.57 rad within 1.8
/// s, seen every 5 ms by 12 bit; let go at a time.
CommandRows lifted(double gain, double off) {
  constexpr double kStep = 1e-4, kQuantum = 2.0 * std::numbers::pi / 4096.0;
  CommandRows rows;
  double x = 0.0, w = 0.0;
  for (int i = 0; i < 60000; ++i) {
    const double t = kStep * i, goal = 0.785 * (1.0 - std::cos(std::numbers::pi * std::min(t / 1.8, 1.0)));
    if (i % 50 == 0) {
      rows.t.push_back(t), rows.target.push_back(goal);
      rows.position.push_back(kQuantum * std::round(x / kQuantum));
    }
    const double motor = t < off ? gain * (goal - x) - 0.03 * w : 0.0;
    w += kStep / 0.0067 * (motor - 0.48 * std::sin(x) - 0.004 * w - 0.02 * std::tanh(w / 0.01));
    x += kStep * w;
  }
  return rows;
}

TEST(LetGo, IsSeenWhereAnArmFallsHoweverWeaklyItWasHeld) {
  for (const double gain : {0.1, 0.4, 3.0}) EXPECT_NEAR(let_go_at(lifted(gain, 2.0)), 2.0, 0.02) << gain;
}

TEST(LetGo, IsNotTakenFromAControllerThatRestsFarOffItsGoal) {
  for (const double gain : {0.1, 0.4, 3.0}) EXPECT_EQ(let_go_at(lifted(gain, 10.0)), kInfinity) << gain;
}

}  // namespace
}  // namespace gapscope::internal::recording
