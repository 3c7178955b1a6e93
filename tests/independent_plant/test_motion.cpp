#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "independent_plant/brute_force.h"
#include "independent_plant/simulate.h"

namespace gapscope::independent_plant {
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
  const BlindRun finest = simulate_blind({}, {}, {}, {.tolerance = 1e-14});
  double coarse_error = 0.0, fine_error = 0.0;
  for (std::size_t k = 0; k < finest.truth.x1.size(); ++k) {
    coarse_error = std::max(coarse_error, std::abs(coarse.truth.x1[k] - finest.truth.x1[k]));
    fine_error = std::max(fine_error, std::abs(fine.truth.x1[k] - finest.truth.x1[k]));
  }
  EXPECT_LT(coarse_error, 1e-7);
  EXPECT_LT(fine_error, 1e-9);
  EXPECT_EQ(coarse.truth.contact_events.size(), finest.truth.contact_events.size());
}

TEST(Motion, AgreesWithAFixedStepSolutionToItsFirstOrder) {
  BlindDrive drive;
  drive.effects.motor.friction.level_nm = 0.01;
  const BlindOptions options{.rate = 1000.0, .duration = 2.0};
  const BlindRun run = simulate_blind(drive, {}, {}, options);
  const auto worst = [&](int fine) {
    const std::vector<double> x1 = brute_force(drive, run.recording.u, run.recording.dt, fine);
    double error = 0.0;
    for (std::size_t k = 0; k < x1.size(); ++k) error = std::max(error, std::abs(x1[k] - run.truth.x1[k]));
    return error;
  };
  const double coarse = worst(250), fine = worst(500);  // 4 and 2 µs
  EXPECT_LT(fine, 2e-5);
  EXPECT_NEAR(coarse / fine, 2.0, 0.3);  // both errors are the fixed step's own
}

TEST(Motion, EnergyNeverGrowsAtZeroInput) {
  BlindDrive drive;
  drive.motor_damping = drive.load_damping = 1e-3;
  drive.load_coulomb = 2e-3;
  drive.contact_damping = 0.02;
  drive.w1 = 3.0;
  drive.w2 = -1.0;
  const Dynamics dynamics(drive, {});
  Motion motion(dynamics, 1e-12);
  double last = motion.energy();
  for (int k = 1; k <= 20000; ++k) {
    motion.advance(5e-5 * k);
    ASSERT_LE(motion.energy(), last + 1e-11) << "at " << motion.time() << " s";  // speeds are good to 1e-9
    last = motion.energy();
  }
  EXPECT_GT(motion.contact_events().size(), 10u);
}

TEST(Motion, RigidImpactScalesTheRelativeSpeedAndKeepsMomentum) {
  for (const double restitution : {1.0, 0.8, 0.3}) {
    BlindDrive drive = lossless();
    drive.contact = ContactKind::kRigid;
    drive.restitution = restitution;
    drive.load_inertia = 2.5 * drive.motor_inertia;
    drive.w1 = 1.0;
    const Dynamics dynamics(drive, {});
    Motion motion(dynamics, 1e-12);
    motion.advance(0.5 * drive.gap + 1e-6);  // one impact
    const double w1 = motion.state()[kW1], w2 = motion.state()[kW2];
    EXPECT_NEAR(w1 + 2.5 * w2, 1.0, 1e-13);
    EXPECT_NEAR(w1 - w2, -restitution, 1e-13);
    if (restitution == 1.0) {  // eq. (3) with the load at rest: (1 + α)/(1 − α)
      EXPECT_NEAR(w1, (1.0 - 2.5) / (1.0 + 2.5), 1e-13);
    }
    motion.advance(0.5 * drive.gap +
                   1.001 * drive.gap * (1.0 / restitution + 1.0 / (restitution * restitution)));
    EXPECT_NEAR(motion.state()[kW1] - motion.state()[kW2], -std::pow(restitution, 3), 1e-12);
  }
}

TEST(Motion, RigidPlasticContactMovesAsOneBodyUntilTheMotorPullsAway) {
  BlindDrive drive = lossless();
  drive.contact = ContactKind::kRigid;
  drive.restitution = 0.0;
  drive.load_coulomb = 0.05;
  const double torque = 0.1, both = drive.motor_inertia + drive.load_inertia;
  const Dynamics dynamics(drive, {});
  Motion motion(dynamics, 1e-12);
  motion.hold(torque / drive.torque_constant);
  motion.advance(0.1);
  ASSERT_EQ(motion.flank_in_contact(), 1);
  const double t_hit = std::sqrt(drive.gap * drive.motor_inertia / torque);
  const double w_hit = torque / drive.motor_inertia * t_hit * drive.motor_inertia / both;
  const double acceleration = (torque - drive.load_coulomb) / both;
  EXPECT_NEAR(motion.state()[kW1], w_hit + acceleration * (0.1 - t_hit), 1e-9);
  EXPECT_EQ(motion.state()[kW1], motion.state()[kW2]);
  motion.hold(-torque / drive.torque_constant);
  EXPECT_EQ(motion.flank_in_contact(), 0);
  ASSERT_EQ(motion.contact_events().size(), 2u);
  EXPECT_FALSE(motion.contact_events().back().closed);
}

TEST(Motion, RigidBouncesEndInAContactThatHolds) {
  BlindDrive drive;
  drive.contact = ContactKind::kRigid;
  drive.restitution = 0.6;
  const BlindRun run = simulate_blind(drive, {}, {}, {.duration = 2.0});
  std::size_t engaged = 0;
  for (const Mode mode : run.recording.mode)
    engaged += mode == Mode::kEngagementPlus || mode == Mode::kEngagementMinus;
  EXPECT_GT(engaged, run.recording.size() / 2);
  double widest = 0.0;
  for (std::size_t k = 0; k < run.truth.x1.size(); ++k)
    widest = std::max(widest, std::abs(run.truth.x1[k] - run.truth.x2[k]));
  EXPECT_NEAR(widest, 0.5 * drive.gap, 1e-12);  // a rigid gap is never overrun
}

TEST(Motion, LockedOutputTurnsTorqueIntoWindUp) {
  BlindDrive drive;
  drive.load = BlindLoad::kLocked;
  const Dynamics dynamics(drive, {});
  Motion motion(dynamics, 1e-12);
  motion.hold(0.5);
  motion.advance(2.0);
  EXPECT_NEAR(motion.state()[kX1], 0.5 * drive.gap + 0.5 * drive.torque_constant / drive.contact_stiffness,
              1e-10);
  EXPECT_EQ(motion.state()[kX2], 0.0);
}

TEST(Motion, OneInertiaHasNoContactAndNoLoad) {
  BlindDrive drive;
  drive.load = BlindLoad::kNone;
  const BlindRun run = simulate_blind(drive, {}, {}, {.duration = 1.0});
  EXPECT_TRUE(run.recording.x2.empty());
  EXPECT_EQ(std::set<Mode>(run.recording.mode.begin(), run.recording.mode.end()), std::set{Mode::kOneBody});
  EXPECT_TRUE(run.truth.contact_events.empty());
  EXPECT_GT(*std::max_element(run.truth.x1.begin(), run.truth.x1.end()), 0.1);
}

TEST(Motion, PassagesMeasureTheGapBetweenTheirEnds) {
  const BlindDrive drive;
  const BlindRun run = simulate_blind(drive, {}, {}, {});
  int crossings = 0;
  for (const GapPassage& p : run.truth.passages) {
    if (p.from_flank != -p.to_flank || p.from_flank == 0) continue;
    ++crossings;
    // From the release, where the damper may still overlap the flanks, to the closing at exactly half a gap.
    EXPECT_NEAR(p.to_flank * (p.x1_t2 - p.x1_t1 - p.load_travel), drive.gap, 0.02 * drive.gap);
    EXPECT_DOUBLE_EQ(p.gap, drive.gap);
  }
  EXPECT_EQ(crossings, 19);  // every half period of 10 s at 1 Hz but the first
}

}  // namespace
}  // namespace gapscope::independent_plant
