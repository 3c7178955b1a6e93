// What is told to paste into a file of the user's own makes that file the drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "exports/mujoco_engine.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kTwoBodies;
using ::testing::Not;
using testing::rig_configuration;
using testing::TemporaryFile;

/// A file of the user's own: what its one body has, and what stands beside the actuator.
struct OwnMjcf {
  std::string inertial = "<inertial pos=\"0 0 0\" mass=\"0.12\" diaginertia=\"4e-4 4e-4 4e-4\"/>";
  std::string joint = "armature=\"1e-4\" damping=\"0.01\"";
  std::string gear = "gear=\"1\"";
  std::string actuator = "";
  std::string body = "", place = "axis=\"0 1 0\"", behind = "", compiler = "";

  std::string text() const {
    return "<mujoco><compiler angle=\"radian\" " + compiler + "/><worldbody><body name=\"link\" " + body +
           ">" + inertial + "<joint name=\"elbow\" " + place + " " + joint + "/>" + behind +
           "</body></worldbody><actuator>" + actuator + "<general joint=\"elbow\" " + gear +
           "/></actuator></mujoco>";
  }
  JointNumbers read() const {
    const TemporaryFile file(text(), "own.xml");
    return joint_numbers(file.path(), "elbow");
  }
};

std::string first_match(const std::string& text, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

std::string told_for(const OwnMjcf& own, const Configuration& c) {
  return export_drive(c, ExportFormat::kMjcf, own.read()).certificate.own_file;
}

/// The file with every part that is told put in its place.
OwnMjcf pasted(OwnMjcf own, const std::string& told) {
  own.joint = first_match(told, "joint: (.*?); actuator");
  own.gear = first_match(told, "actuator: ([^;(]*)");
  if (const std::string inertial = first_match(told, "(<inertial [^>]*/>)"); !inertial.empty()) {
    const bool whole = inertial.find("fullinertia") != inertial.npos;
    const std::string kept = " " + first_match(own.inertial, "((?:diag|full)inertia=\"[^\"]*\")") + "/>";
    own.inertial = whole ? inertial : inertial.substr(0, inertial.size() - 2) + kept;
  }
  if (const std::string bias = first_match(told, "(<general [^>]*/>)"); !bias.empty()) own.actuator = bias;
  return own;
}

Configuration hanging_drive(double amplitude, double phase) {
  return rig_configuration(", mass_ratio: 0",
                           fmt::format("  effects: [{{load_unbalance: {{amplitude_nm: {}, phase_rad: {}}}}}, "
                                       "{{motor_coulomb_friction: {{level_nm: 0.02}}}}]\n",
                                       amplitude, phase));
}

void expect_same(const JointNumbers& n, double amplitude, double phase) {
  EXPECT_NEAR(n.unbalance * std::cos(n.unbalance_phase), amplitude * std::cos(phase), 2e-3 * amplitude);
  EXPECT_NEAR(n.unbalance * std::sin(n.unbalance_phase), amplitude * std::sin(phase), 2e-3 * amplitude);
}

constexpr double kInertia = 8.78e-4;  // of the rig [kg m²]

/// Four digits of a place: a thousandth of the gravity, and of what the mass has about the axis.
TEST(OwnFile, GivesTheCentreOfMassThatHasTheGravityThatWasFound) {
  const std::string fixed =
      R"(<body pos="-0.02 0.01 0"><inertial pos="0 0 0" mass="0.05" diaginertia="1e-6 1e-6 1e-6"/></body>)";
  const std::string mass = R"(<inertial pos="0.02 0.03 -0.01" mass="0.12" diaginertia="2e-4 2e-4 2e-4"/>)";
  const std::string geom = R"(<geom type="box" size="0.05 0.01 0.01" pos="0.03 0 0" mass="0.12"/>)";
  const struct {
    const char* name;
    OwnMjcf own;
  } cases[] = {
      {"on the axis", {}},
      {"on the wrong side",
       {.inertial = R"(<inertial pos="0.05 0 0" mass="0.12" diaginertia="1e-4 1e-4 1e-4"/>)"}},
      {"beside a part that is fixed to it", {.inertial = mass, .behind = fixed}},
      {"in a turned body about a joint beside its origin",
       {.inertial = mass,
        .body = "euler=\"0.3 -0.4 0.7\"",
        .place = "axis=\"1 2 -0.5\" pos=\"0.01 0 0.02\" ref=\"0.4\""}},
      {"of a geom", {.inertial = geom}},
      {"half of it held by gravcomp", {.inertial = mass, .body = "gravcomp=\"0.5\""}},
  };
  for (const auto& c : cases)
    for (const double phase : {0.0, kPi / 2.0, -2.5}) {
      SCOPED_TRACE(fmt::format("{}, phase {}", c.name, phase));
      const std::string told = told_for(c.own, hanging_drive(0.04, phase));
      EXPECT_THAT(told, HasSubstr("gravity: 0.04 N m at phase"));
      const JointNumbers n = pasted(c.own, told).read();
      expect_same(n, 0.04, phase);
      if (told.find("off the body's own") == told.npos) {
        EXPECT_NEAR(n.inertia, kInertia, 1e-3 * kInertia);
      }
    }
}

/// A fit of little noise knows its numbers to a millionth: what is pasted stays within its intervals.
TEST(OwnFile, RoundsNoNumberOutOfItsInterval) {
  const OwnMjcf own;
  const Configuration c = hanging_drive(2.236671727955889, -1.470790143775452);
  const JointNumbers n = pasted(own, told_for(own, c)).read();
  EXPECT_NEAR(n.unbalance, 2.236671727955889, 2e-7 * 2.2367);
  EXPECT_NEAR(n.unbalance_phase, -1.470790143775452, 2e-7);
  EXPECT_THAT(told_for(own, c), HasSubstr("gravity: 2.2366717 N m at phase -1.4707901 rad"));
}

/// No factor mends a mass on the wrong side.
TEST(OwnFile, MovesAMassToTheOtherSideOfItsAxis) {
  OwnMjcf own;
  own.inertial = R"(<inertial pos="0.1182 0 0" mass="1.8" diaginertia="1e-4 1e-4 1e-4"/>)";
  const std::string told = told_for(own, hanging_drive(2.119, kPi / 2.0));
  EXPECT_THAT(told, HasSubstr("gravity: 2.119 N m at phase 1.5707963 rad instead of "));
  EXPECT_THAT(told, HasSubstr(": <inertial pos=\"-0.12000227 0 0\" mass=\"1.8\"/> in body link"));
  EXPECT_THAT(told, Not(HasSubstr("times")));
}

TEST(OwnFile, SaysNothingOfAGravityThatItHas) {
  OwnMjcf own;
  own.inertial = R"(<inertial pos="0 0 -0.05" mass="0.12" diaginertia="1e-4 1e-4 1e-4"/>)";
  EXPECT_THAT(told_for(own, hanging_drive(0.12 * 0.05 * 9.81, 0.0)), Not(HasSubstr("gravity")));
}

TEST(OwnFile, PutsTheMassOnTheAxisWhereTheDriveHasNoGravity) {
  OwnMjcf own;
  own.inertial = R"(<inertial pos="0.03 0.01 -0.05" mass="0.12" diaginertia="1e-4 1e-4 1e-4"/>)";
  const std::string told = told_for(own, rig_configuration(", mass_ratio: 0"));
  EXPECT_THAT(told, HasSubstr("gravity: none instead of"));
  EXPECT_THAT(told, HasSubstr("<inertial pos=\"0 0.01 0\" mass=\"0.12\"/>"));
}

/// A file that does not tell the mass (here of a mesh) still has a direction and an amount.
TEST(OwnFile, TurnsWhatHangsWhereItsMassIsNotTold) {
  const Configuration c = hanging_drive(0.05, 1.0);
  JointNumbers own;
  own.model = "arm.xml", own.joint = "elbow", own.unbalance = 0.04, own.unbalance_phase = -1.0;
  const auto told = [&] { return export_drive(c, ExportFormat::kMjcf, own).certificate.own_file; };
  EXPECT_THAT(told(),
              HasSubstr("by 2 rad about its axis, and the mass, or its distance from the axis, times 1.25 "));
  own.unbalance = kNaN;
  EXPECT_THAT(
      told(),
      HasSubstr(
          "0.05 N m at phase 1 rad instead of none: no centre of the body of elbow in arm.xml has that"));
  EXPECT_THAT(export_drive(c, ExportFormat::kMjcf).certificate.own_file,
              HasSubstr("gravity: 0.05 N m at phase 1 rad: export --into MODEL"));
}

/// MuJoCo's default axis is z: about the vertical.
TEST(OwnFile, SaysThatABodyAboutTheVerticalHasNoGravity) {
  OwnMjcf own;
  own.place = "";
  EXPECT_THAT(told_for(own, hanging_drive(0.05, 1.0)), HasSubstr("its axis is upright"));
}

TEST(OwnFile, GivesAConstantTorqueFilterAndRangeOfTheActuator) {
  const Configuration c = rig_configuration(
      ", mass_ratio: 0",
      "  effects: [{constant_load_torque: {torque_nm: -0.013}}, {actuator_lag: {time_constant_s: 2.0e-3}}, "
      "{torque_saturation: {knee: 0.5}}]\n");
  const OwnMjcf own;
  const std::string told = told_for(own, c);
  EXPECT_THAT(
      told, HasSubstr("<general joint=\"elbow\" gainprm=\"0\" biastype=\"affine\" biasprm=\"-0.013 0 0\"/>"));
  const OwnMjcf mended = pasted(own, told);
  const JointNumbers n = mended.read();
  EXPECT_DOUBLE_EQ(n.constant_torque, -0.013);
  EXPECT_DOUBLE_EQ(n.lag, 2e-3);
  EXPECT_DOUBLE_EQ(n.input_limit, 0.5);
  EXPECT_DOUBLE_EQ(n.torque_constant, 0.172);
  EXPECT_THAT(told_for(mended, c), Not(HasSubstr("among the actuators"))) << "it has it";
  const testing::MujocoEngineRun engine(mended.text());
  EXPECT_EQ(engine.model().nu, 2);
}

/// Gravity along a slide is a constant force that the file has by its mass.
TEST(OwnFile, TakesASlidesWeightOffItsConstantForce) {
  OwnMjcf own;
  own.place = "type=\"slide\" axis=\"0 0 1\"";
  const Configuration c =
      rig_configuration(", mass_ratio: 0", "  effects: [{constant_load_torque: {torque_nm: -1.2}}]\n",
                        "coordinates: translation\nencoder: {quantum: 6.0e-6}");
  const JointNumbers n = pasted(own, told_for(own, c)).read();
  EXPECT_NEAR(n.weight, -0.12 * 9.81, 1e-12);
  EXPECT_NEAR(n.constant_torque, -1.2, 1e-6);
}

TEST(OwnFile, OfADriveWithAGapHasBothJointsAndTheTendon) {
  const DriveExport drive = export_drive(rig_configuration(kTwoBodies), ExportFormat::kMjcf);
  const TemporaryFile file(drive.files[0].text, "own.xml");
  const Configuration other =
      rig_configuration(kTwoBodies, "  effects: [{load_unbalance: {amplitude_nm: 0.03, phase_rad: 0.4}}]\n");
  const std::string told =
      export_drive(other, ExportFormat::kMjcf, joint_numbers(file.path(), "rig_motor")).certificate.own_file;
  EXPECT_THAT(told, HasSubstr("joint of the load: armature=\""));
  EXPECT_THAT(told, HasSubstr("tendon of the gap, motor - load: limited=\"true\" range=\"-0.0095 0.0095\" "
                              "solreflimit=\"-"));
  EXPECT_THAT(told, HasSubstr("mass=\"1\"/> in body rig_load"));
}

/// The file of one joint with what is told put into it is the exported drive.
TEST(OwnFile, GivesAFileOfOneJointTheMotorThatAGapNeeds) {
  const OwnMjcf own{.body = "pos=\"0 0 0.5\""};
  const Configuration c =
      rig_configuration(kTwoBodies, "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n");
  const std::string told = told_for(own, c);
  EXPECT_THAT(
      told,
      HasSubstr("has one joint, elbow, which is taken for the load's; the motor needs a body and a "
                "joint of its own, beside the body of elbow: <body name=\"elbow_motor\" pos=\"0 0 0.5\">"));
  EXPECT_THAT(told, HasSubstr("frictionloss=\"0.03\""));
  EXPECT_THAT(told, HasSubstr("actuator, on the motor from now on: joint=\"elbow_motor\""));
  OwnMjcf mended = own;
  mended.joint = first_match(told, "joint of the load, elbow: (.*?); <tendon>");
  std::string text = mended.text();
  const auto put = [&](const std::string& before, const std::string& what) {
    text.insert(text.find(before), what);
  };
  put("<body name=\"link\"", first_match(told, "(<body name=.*?</body>)"));
  put("<actuator>", first_match(told, "(<tendon>.*?</tendon>)"));
  const std::string actuator = "<general joint=\"elbow\" gear=\"1\"/>";
  text.replace(text.find(actuator), actuator.size(),
               "<general " + first_match(told, "from now on: ([^;]*)") + "/>");
  testing::MujocoEngineRun pasted_in(text), exported(export_drive(c, ExportFormat::kMjcf).files[0].text);
  std::vector<double> u;
  for (int i = 0; i < 20000; ++i) u.push_back(0.6 * std::sin(2.0 * kPi * 1e-4 * i));
  const auto one = pasted_in.motion(1e-4, mjINT_RK4, u), other = exported.motion(1e-4, mjINT_RK4, u);
  ASSERT_EQ(one.size(), other.size());
  double apart = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) apart = std::max(apart, std::abs(one[i] - other[i]));
  EXPECT_LT(apart, 1e-3) << "of a travel of a radian: the contact tells small differences apart";
  EXPECT_THAT(export_drive(c, ExportFormat::kMjcf).certificate.own_file,
              HasSubstr("a model of one joint has the load's: export --into MODEL"));
}

TEST(OwnFile, SaysThatALoadWithoutFrictionIsMeant) {
  const OwnMjcf own;
  const std::string told = told_for(
      own, rig_configuration(", mass_ratio: 1.5, gap: 0.019, load_damping: 0.035, contact_stiffness: 200, "
                             "contact_damping: 0.05",
                             "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n"));
  EXPECT_THAT(told, HasSubstr("frictionloss=\"0\" (the friction that was found is all the motor's)"));
}

}  // namespace
}  // namespace gapscope
