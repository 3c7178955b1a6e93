#include <gtest/gtest.h>

#include <cmath>

#include "independent_plant/simulate.h"
#include "signals/one_body.h"

namespace gapscope::internal::signals {
namespace {

TEST(OneBody, TheBalanceOfOneInertiaIsItsOwn) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.effects.motor.friction.level_nm = 0.01;
  independent_plant::BlindExcitation excitation;
  excitation.waveform = independent_plant::Waveform::kMultisine;
  const Recording recording =
      independent_plant::simulate_blind(drive, excitation, independent_plant::BlindSensor::with_bits(20),
                                        {1000.0, 4.0, 1, 1e-10})
          .recording;
  const MotorTrace traces[] = {recording.motor_trace()};
  const OneBody body = as_one_body(traces);
  // Speeds are slopes over 20 ms and the balance has 500 rows: some percent, enough for a start.
  EXPECT_NEAR(0.172 * body.inertia / 8.78e-4, 1.0, 0.2);
  EXPECT_NEAR(0.172 * body.damping / 0.062, 1.0, 0.05);
  EXPECT_NEAR(0.172 * body.friction / 0.01, 1.0, 0.2);
  EXPECT_NEAR(body.peak_input, 0.5814, 0.01);
}

/// An arm that hangs down at `hangs`, driven so that it goes x1 = 2 + 1.2 sin(3 t) + 0.4 sin(7 t).
Recording pendulum(double hangs, double sign = 1.0) {
  Recording r;
  r.dt = 0.002;
  for (int i = 0; i < 4000; ++i) {
    const double t = r.dt * i;
    const double w = 3.6 * std::cos(3.0 * t) + 2.8 * std::cos(7.0 * t);
    const double a = -10.8 * std::sin(3.0 * t) - 19.6 * std::sin(7.0 * t);
    r.x1.push_back(2.0 + 1.2 * std::sin(3.0 * t) + 0.4 * std::sin(7.0 * t));
    const double gravity = 0.7 * std::sin(r.x1.back() - hangs);
    r.u.push_back(sign * (0.02 * a + 0.03 * w + 0.05 * (w > 0.0 ? 1.0 : -1.0) + gravity));
  }
  return r;
}

TEST(HangingArm, IsReadFromTheTorqueThatGoesWithThePosition) {
  for (const double hangs : {0.0, 0.4, 3.0, -1.9}) {
    const Recording r = pendulum(hangs);
    const HangingArm arm = hanging_arm(r.motor_trace());
    EXPECT_NEAR(arm.angle, hangs, 0.03) << "speeds are slopes over 20 ms";
    EXPECT_NEAR(arm.gravity / 0.7, 1.0, 0.03);
    EXPECT_NEAR(arm.inertia / 0.02, 1.0, 0.1);
    EXPECT_LT(arm.left, 0.01);
  }
}

TEST(HangingArm, OfAnInputWithTheOtherSignIsToldByItsInertia) {
  const Recording r = pendulum(0.4, -1.0);
  EXPECT_LT(hanging_arm(r.motor_trace()).inertia, 0.0);
}

}  // namespace
}  // namespace gapscope::internal::signals
