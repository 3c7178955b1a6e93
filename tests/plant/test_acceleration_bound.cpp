#include <gtest/gtest.h>

#include "plant/acceleration_bound.h"

namespace gapscope {
namespace {

/// The application example, Section III-D.
DriveParameters<double> application_example() {
  DriveParameters<double> drive;
  drive.motor_inertia = 8.78e-4;
  drive.torque_constant = 0.172;
  drive.mass_ratio = 1.0;
  return drive;
}

TEST(AccelerationBound, SectionIIIDGivesBetween98And147) {
  const Interval bound = acceleration_bound(application_example(), {0.5, 5e-5});
  EXPECT_NEAR(bound.low, 98.0, 0.5);  // printed without decimals
  EXPECT_NEAR(bound.high, 147.0, 0.5);
}

TEST(AccelerationBound, WithoutPerturbationItIsTorqueOverInertiaAndItsEngagedMultiple) {
  // With G = 0 eq. (12) reduces to Umax Km/m1 · (1 + |α|/(1 + |α|)).
  DriveParameters<double> drive = application_example();
  drive.mass_ratio = 3.0;
  const Interval bound = acceleration_bound(drive, {0.5, 0.0});
  const double torque_over_inertia = 0.5 * 0.172 / 8.78e-4;
  EXPECT_DOUBLE_EQ(bound.low, torque_over_inertia);
  EXPECT_DOUBLE_EQ(motor_acceleration_bound(drive, 0.5), torque_over_inertia);
  EXPECT_NEAR(bound.high, torque_over_inertia * 1.75, 1e-12 * torque_over_inertia);
}

TEST(AccelerationBound, CoulombFrictionAsATorqueNeedsAMuchLargerG) {
  // 0.05 N m of Coulomb friction and 0.035 N m s/rad at the example's speeds: G = 5e-5 does not bound them as
  // torques.
  const Interval published = acceleration_bound(application_example(), {0.5, 5e-5});
  const Interval as_torque = acceleration_bound(application_example(), {0.5, 0.063});
  EXPECT_GT(as_torque.low, 1.7 * published.low);
}

TEST(AccelerationBound, ChosenBoundLiesFivePercentIntoTheInterval) {
  EXPECT_DOUBLE_EQ(chosen_bound({100.0, 200.0}), 105.0);
}

}  // namespace
}  // namespace gapscope
