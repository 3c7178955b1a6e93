// What goes to MuJoCo comes back as the same numbers.
#include <gtest/gtest.h>

#include "exports/exported_drives.h"
#include "gapscope/config/joint_numbers.h"
#include "gapscope/exports/export.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

JointNumbers back(const Configuration& c) {
  const DriveExport drive = export_drive(c, ExportFormat::kMjcf);
  const testing::TemporaryFile file(drive.files[0].text, "model.xml");
  return joint_numbers(file.path(), c.name + "_motor");
}

TEST(RoundTrip, OfAnMjcfKeepsEveryNumberOfTheDrive) {
  for (const char* top : {"encoder: {bits: 20}", "coordinates: translation\nencoder: {quantum: 6.0e-6}"}) {
    const Configuration c = testing::rig_configuration(
        testing::kTwoBodies, "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n", top);
    const DriveParameters<double>& p = c.simulation->plant.drive;
    const JointNumbers n = back(c);
    EXPECT_EQ(n.slides, !c.coordinates.rotational());
    EXPECT_DOUBLE_EQ(n.inertia, p.motor_inertia);
    EXPECT_DOUBLE_EQ(n.torque_constant, p.torque_constant);
    EXPECT_DOUBLE_EQ(n.damping, p.motor_damping);
    EXPECT_DOUBLE_EQ(n.friction, 0.01);
    EXPECT_NEAR(n.gap, p.gap, 1e-15);
    EXPECT_DOUBLE_EQ(n.load_inertia, p.motor_inertia * p.mass_ratio);
    EXPECT_DOUBLE_EQ(n.load_damping, p.load_damping);
    EXPECT_DOUBLE_EQ(n.load_friction, p.load_coulomb_friction);
    EXPECT_NEAR(n.stiffness, p.contact_stiffness, 1e-9 * p.contact_stiffness);
    EXPECT_NEAR(n.contact_damping, p.contact_damping, 1e-9 * p.contact_damping);
  }
}

TEST(RoundTrip, OfAUrdfKeepsWhatItCarries) {
  const Configuration c =
      testing::rig_configuration(", mass_ratio: 0", "  effects: [{load_unbalance: {amplitude_nm: 0.01}}]\n");
  const DriveExport drive = export_drive(c, ExportFormat::kUrdf);
  const testing::TemporaryFile file(drive.files[0].text, "model.urdf");
  const JointNumbers n = joint_numbers(file.path(), "rig_joint");
  EXPECT_NEAR(n.inertia, c.simulation->plant.drive.motor_inertia, 1e-14);
  EXPECT_DOUBLE_EQ(n.damping, c.simulation->plant.drive.motor_damping);
}

}  // namespace
}  // namespace gapscope
