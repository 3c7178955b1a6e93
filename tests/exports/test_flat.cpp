// The formats of one joint: other programs read them, and their certificates name what they lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sdf/sdf.hh>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kTwoBodies;
using testing::rig_configuration;

const std::string kStribeck =
    "  effects: [{stribeck_friction: {level_nm: 0.01, stiction_ratio: 0.5, stribeck_speed_rad_s: 0.1}}]\n";

std::vector<Configuration> drives() {
  return {
      rig_configuration(kTwoBodies),
      rig_configuration(", mass_ratio: 0", "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n"),
      rig_configuration(kTwoBodies, "  effects: [{load_unbalance: {amplitude_nm: 0.01, phase_rad: 0.7}}]\n"),
      rig_configuration(", gap: 0.019, contact_stiffness: 200, contact_damping: 0.05", "  load: locked\n"),
      rig_configuration(kTwoBodies, "", "coordinates: translation\nencoder: {quantum: 6.0e-6}")};
}

Fidelity fidelity(const Certificate& c, const std::string& part) {
  for (const CarriedPart& p : c.parts)
    if (p.part == part) return p.fidelity;
  ADD_FAILURE() << part << " is in no certificate";
  return Fidelity::kExact;
}

TEST(Urdf, IsReadByCheckUrdf) {
  for (const Configuration& c : drives()) {
    const DriveExport drive = export_drive(c, ExportFormat::kUrdf);
    const testing::TemporaryFile file(drive.files[0].text, drive.files[0].name);
    EXPECT_EQ(
        std::system(("check_urdf " + file.path() + " >" + file.folder().string() + "/said 2>&1").c_str()), 0)
        << drive.files[0].text;
  }
}

TEST(Sdf, IsReadByLibsdformatWithTheNumbersOfTheDrive) {
  for (const Configuration& c : drives()) {
    const DriveExport drive = export_drive(c, ExportFormat::kSdf);
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(drive.files[0].text);
    for (const auto& error : errors) ADD_FAILURE() << error.Message();
    ASSERT_NE(root.Model(), nullptr);
    const sdf::Joint* joint = root.Model()->JointByName(drive.certificate.name + "_joint");
    ASSERT_NE(joint, nullptr);
    const DriveParameters<double>& p = c.simulation->plant.drive;
    const bool free =
        c.simulation->plant.structure.has_load && c.simulation->plant.structure.load == LoadKind::kFree;
    EXPECT_DOUBLE_EQ(joint->Axis()->Damping(), p.motor_damping + (free ? p.load_damping : 0.0));
    const auto& inertial = root.Model()->LinkByName(drive.certificate.name + "_output")->Inertial();
    // About the axis: what turns, wherever its centre is. On a slide the mass is what moves.
    const auto centre = inertial.Pose().Pos();
    const double mass = inertial.MassMatrix().Mass();
    const double turning =
        inertial.MassMatrix().Iyy() + mass * (centre.X() * centre.X() + centre.Z() * centre.Z());
    EXPECT_NEAR(c.coordinates.rotational() ? turning : mass,
                p.motor_inertia * (1.0 + (free ? p.mass_ratio : 0.0)), 1e-12);
  }
}

TEST(Flat, NamesWhatItLosesAndHowFarItThenIs) {
  for (const ExportFormat format :
       {ExportFormat::kUrdf, ExportFormat::kSdf, ExportFormat::kIsaac, ExportFormat::kBam}) {
    const Certificate c = export_drive(rig_configuration(kTwoBodies), format).certificate;
    for (const char* lost : {"gap", "contact_stiffness", "contact_damping", "torque_constant"})
      EXPECT_EQ(fidelity(c, lost), Fidelity::kLeftOut) << lost;
    EXPECT_EQ(fidelity(c, "mass_ratio"), Fidelity::kApproximate);
    ASSERT_EQ(c.errors.size(), 1u);
    EXPECT_GT(c.errors[0].max, 0.25 * 0.019) << "what moves in the gap is lost with it";
    EXPECT_FALSE(c.errors[0].within_encoder);
  }
}

/// One inertia with dry friction is all that these formats have: nothing is left.
TEST(Flat, IsExactForOneInertia) {
  const Configuration c =
      rig_configuration(", mass_ratio: 0", "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n");
  for (const ExportFormat format : {ExportFormat::kUrdf, ExportFormat::kIsaac, ExportFormat::kBam})
    EXPECT_LE(export_drive(c, format).certificate.errors[0].max, 1e-12);
}

TEST(Isaac, IsPythonWithTheNumbersOfTheDrive) {
  const DriveExport drive = export_drive(rig_configuration(kTwoBodies, kStribeck), ExportFormat::kIsaac);
  const testing::TemporaryFile file(drive.files[0].text, drive.files[0].name);
  EXPECT_EQ(std::system(("python3 -m py_compile " + file.path()).c_str()), 0);
  EXPECT_THAT(drive.files[0].text, HasSubstr("armature=0.000878,"));
  EXPECT_THAT(drive.files[0].text, HasSubstr("friction=0.045,  # at rest"));
  EXPECT_THAT(drive.files[0].text, HasSubstr("dynamic_friction=0.04,"));
  EXPECT_THAT(drive.files[0].text, HasSubstr("viscous_friction=0.097,"));
}

TEST(Bam, IsTheLeastOfItsModelsThatHasTheEffects) {
  const auto bam = nlohmann::json::parse(
      export_drive(rig_configuration(kTwoBodies, kStribeck), ExportFormat::kBam).files[0].text);
  EXPECT_EQ(bam["model"], "m2");
  EXPECT_NEAR(bam["friction_stribeck"], 0.005, 1e-12);
  EXPECT_NEAR(bam["friction_base"], 0.04, 1e-12);
  const DriveExport loaded = export_drive(
      rig_configuration(kTwoBodies, "  effects: [{load_dependent_friction: {level_nm: 0.01, ratio: 0.1}}]\n"),
      ExportFormat::kBam);
  EXPECT_EQ(nlohmann::json::parse(loaded.files[0].text)["model"], "m3");
  EXPECT_THAT(loaded.certificate.warnings.at(0), HasSubstr("kt and R are not in the file"));
}

}  // namespace
}  // namespace gapscope
