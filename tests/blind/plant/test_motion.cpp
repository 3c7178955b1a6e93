#include <gtest/gtest.h>

#include <cmath>

#include "blind/plant/simulate.h"

namespace gapscope::blind {
namespace {

/// A drive without friction, damping or contact damping, in the middle of its gap.
BlindDrive lossless() {
  BlindDrive drive;
  drive.motor_damping = drive.load_damping = drive.load_coulomb = drive.contact_damping = 0.0;
  return drive;
}

/// Moves the drive at zero input.
Motion coast(const Dynamics& dynamics, double until) {
  Motion motion(dynamics, 1e-12);
  motion.advance(until);
  return motion;
}

TEST(Motion, SpeedOfADampedMotorInTheGapDecaysExponentially) {
  BlindDrive drive;
  drive.gap = 1.0;  // never crossed: the motor comes to rest after w1·m1/d1 = 14 mrad
  drive.w1 = 1.0;
  const Dynamics dynamics(drive, {});
  const Motion motion = coast(dynamics, 0.05);
  const double rate = drive.motor_damping / drive.motor_inertia;
  EXPECT_NEAR(motion.state()[kW1], std::exp(-rate * 0.05), 1e-8);  // speeds are held to 1e3 tolerances a step
  EXPECT_NEAR(motion.state()[kX1], -std::expm1(-rate * 0.05) / rate, 1e-11);
  EXPECT_EQ(motion.state()[kX2], 0.0);
  EXPECT_TRUE(motion.contact_events().empty());
}

TEST(Motion, LoadStopsWhenItsCoulombFrictionHasEatenItsMomentum) {
  BlindDrive drive;
  drive.gap = 10.0;
  drive.load_damping = 0.0;
  drive.w2 = 2.0;
  const Dynamics dynamics(drive, {});
  const double deceleration = drive.load_coulomb / drive.load_inertia;
  const double stop = drive.w2 / deceleration;
  EXPECT_GT(coast(dynamics, stop - 1e-9).state()[kW2], 0.0);
  const Motion after = coast(dynamics, stop + 1e-9);
  EXPECT_EQ(after.state()[kW2], 0.0);
  EXPECT_EQ(after.regime().load, 0);
  EXPECT_NEAR(after.state()[kX2], drive.w2 * drive.w2 / (2.0 * deceleration), 1e-13);  // a parabola is exact
}

TEST(Motion, ClosedContactSwingsAtTheReducedInertiaAndOpensAfterHalfAPeriod) {
  BlindDrive drive = lossless();
  drive.x1 = 0.5 * drive.gap;
  drive.w1 = 1.0;
  const Dynamics dynamics(drive, {});
  const double reduced =
      drive.motor_inertia * drive.load_inertia / (drive.motor_inertia + drive.load_inertia);
  const double half_period = kPi * std::sqrt(reduced / drive.contact_stiffness);
  const Motion motion = coast(dynamics, 2.0 * half_period);
  ASSERT_EQ(motion.contact_events().size(), 2u);
  EXPECT_NEAR(motion.contact_events()[1].time, half_period, 1e-10);
  EXPECT_NEAR(motion.state()[kW2], 1.0, 1e-8);  // equal masses swap their speeds
  EXPECT_NEAR(motion.state()[kW1], 0.0, 1e-8);
}

TEST(Motion, MomentumIsKeptThroughManyImpactsWithoutFriction) {
  BlindDrive drive = lossless();
  drive.contact_damping = 0.05;
  drive.load_inertia = 3.0 * drive.motor_inertia;
  drive.w1 = 1.0;
  const Dynamics dynamics(drive, {});
  const Motion motion = coast(dynamics, 2.0);
  EXPECT_GT(motion.contact_events().size(), 6u);
  EXPECT_NEAR(motion.state()[kW1] + 3.0 * motion.state()[kW2], 1.0, 1e-8);
}

TEST(Motion, HalvingTheToleranceTenfoldChangesTheRunLessThanTheCoarserTolerancePromises) {
  const BlindRun coarse = simulate_blind({}, {}, {}, {.tolerance = kFastTolerance});
  const BlindRun fine = simulate_blind({}, {}, {}, {});
  const BlindRun finest = simulate_blind({}, {}, {}, {.tolerance = 1e-13});
  double coarse_error = 0.0, fine_error = 0.0;
  for (std::size_t k = 0; k < finest.truth.x1.size(); ++k) {
    coarse_error = std::max(coarse_error, std::abs(coarse.truth.x1[k] - finest.truth.x1[k]));
    fine_error = std::max(fine_error, std::abs(fine.truth.x1[k] - finest.truth.x1[k]));
  }
  EXPECT_LT(coarse_error, 1e-7);
  EXPECT_LT(fine_error, 1e-9);
  EXPECT_EQ(coarse.truth.contact_events.size(), finest.truth.contact_events.size());
}

}  // namespace
}  // namespace gapscope::blind
