// What the models of simulators say of a joint's drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config/joint_numbers.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

JointNumbers read(const std::string& xml, const std::string& joint) {
  const testing::TemporaryFile file(xml, "model.xml");
  return joint_numbers(file.path(), joint);
}

std::string refused(const std::string& xml, const std::string& joint) {
  try {
    read(xml, joint);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(JointNumbers, OfAnMjcfComeFromTheJointItsClassAndTheClassAround) {
  const std::string xml = R"(<mujoco>
  <default><joint damping="0.1" armature="0.01"/>
    <default class="servo"><joint frictionloss="0.2"/><default class="small"><joint armature="0.002"/></default></default>
  </default>
  <worldbody><body childclass="servo">
    <inertial pos="0 0 0.1" mass="2" diaginertia="0.001 0.002 0.003"/>
    <joint name="a" class="small" axis="1 0 0"/>
    <body><inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/><joint name="b" damping="0.5"/></body>
  </body></worldbody>
  <actuator><motor joint="a" gear="3"/></actuator></mujoco>)";
  const JointNumbers a = read(xml, "a");
  EXPECT_DOUBLE_EQ(a.inertia, 0.002 + 0.001 + 2.0 * 0.01);  // about x through the joint: m z² beside Ixx
  EXPECT_DOUBLE_EQ(a.damping, 0.1);
  EXPECT_DOUBLE_EQ(a.friction, 0.2);
  EXPECT_DOUBLE_EQ(a.torque_constant, 3.0);
  EXPECT_TRUE(std::isnan(a.gap));
  EXPECT_THAT(a.notes.at(0), HasSubstr("not of the bodies behind it"));
  const JointNumbers b = read(xml, "b");
  EXPECT_DOUBLE_EQ(b.inertia, 0.011);
  EXPECT_DOUBLE_EQ(b.damping, 0.5);
  EXPECT_DOUBLE_EQ(b.friction, 0.2);
  EXPECT_TRUE(std::isnan(b.torque_constant));
}

TEST(JointNumbers, OfAnMjcfKnowTheGapOfANarrowSecondJoint) {
  const std::string body = R"(<worldbody><body><inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>
    <joint name="drive" armature="0.01"/><joint name="play" range="-1 1" limited="true"/></body></worldbody>)";
  EXPECT_NEAR(read("<mujoco>" + body + "</mujoco>", "drive").gap, 2.0 * 3.14159265358979 / 180.0, 1e-12);
  EXPECT_TRUE(std::isnan(read("<mujoco><compiler angle=\"radian\"/>" + body + "</mujoco>", "drive").gap))
      << "two radians are no gap";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = body;
    return std::isnan(
        read("<mujoco>" + other.replace(other.find(from), from.size(), to) + "</mujoco>", "drive").gap);
  };
  EXPECT_TRUE(with("limited=\"true\"", "limited=\"false\""));
  EXPECT_TRUE(with("name=\"play\"", "name=\"play\" axis=\"1 0 0\"")) << "about another axis";
}

TEST(JointNumbers, OfAnMjcfKnowTheGapOfATendonThroughItsCoefficients) {
  const auto numbers = [](const std::string& tendon, const char* own, const char* other) {
    return read(
        R"(<mujoco><compiler autolimits="false"/><worldbody><body><joint name="a" armature="1e-3"/></body>
      <body><joint name="b" armature="2e-3"/></body></worldbody><tendon><fixed range="-0.01 0.01" )" +
            tendon + "><joint joint=\"a\" coef=\"" + own + "\"/><joint joint=\"b\" coef=\"" + other +
            "\"/></fixed></tendon></mujoco>",
        "a");
  };
  EXPECT_DOUBLE_EQ(numbers("limited=\"true\"", "1", "-1").gap, 0.02);
  EXPECT_DOUBLE_EQ(numbers("limited=\"true\"", "2", "-2").gap, 0.01);
  const JointNumbers geared = numbers("limited=\"true\"", "1", "-50");
  EXPECT_TRUE(std::isnan(geared.gap));
  EXPECT_THAT(geared.notes.back(), HasSubstr("no gap between two joints that go alike (coef)"));
  EXPECT_TRUE(std::isnan(numbers("limited=\"false\"", "1", "-1").gap));
  EXPECT_TRUE(std::isnan(numbers("", "1", "-1").gap)) << "autolimits";
}

TEST(JointNumbers, OfAnMjcfHaveTheMassOfTheWhole) {
  const auto inertia = [](const std::string& compiler, const std::string& more) {
    return read("<mujoco><compiler " + compiler + R"(/><worldbody><body><joint name="a" armature="0.5"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)" +
                    more +
                    R"(<body><joint name="b"/><inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/></body>
      </body></worldbody></mujoco>)",
                "a");
  };
  EXPECT_DOUBLE_EQ(inertia("settotalmass=\"8\"", "").inertia, 0.5 + 2.0);
  const JointNumbers open =
      inertia("", "<replicate count=\"3\"><body><geom size=\"0.1\"/></body></replicate>");
  EXPECT_DOUBLE_EQ(open.inertia, 0.5);
  EXPECT_THAT(open.notes.front(), HasSubstr("is that of a replicate, which is not read"));
}

std::string hanging(const std::string& in_body, const std::string& above = "",
                    const std::string& joint = "") {
  return "<mujoco><compiler angle=\"radian\"/><worldbody>" + above +
         "<body name=\"arm\"><joint name=\"a\" axis=\"0 1 0\" " + joint +
         "/><inertial pos=\"0 0 -0.05\" mass=\"0.12\" diaginertia=\"1e-4 1e-4 1e-4\"/>" + in_body +
         "</body>" + (above.empty() ? "" : "</body>") + "</worldbody></mujoco>";
}

TEST(JointNumbers, OfAnMjcfKnowGravityOnWhatHangsOnAHinge) {
  const JointNumbers n = read(hanging(""), "a");
  EXPECT_NEAR(n.unbalance, 0.12 * 0.05 * 9.81, 1e-12);
  EXPECT_NEAR(n.unbalance_phase, 0.0, 1e-12);
  EXPECT_THAT(n.notes, IsEmpty());
  const std::string fixed =
      R"(<body pos="-0.1 0 0"><inertial pos="0 0 0" mass="0.2" diaginertia="0 0 0"/></body>)";
  const JointNumbers both = read(hanging(fixed), "a");
  // The second mass lies along −x: at q = 0 it turns the arm about +y by −(−0.1)·(−m g), which is −G
  // sin(phase).
  EXPECT_NEAR(both.unbalance * std::cos(both.unbalance_phase), 0.12 * 0.05 * 9.81, 1e-12);
  EXPECT_NEAR(-both.unbalance * std::sin(both.unbalance_phase), -0.1 * 0.2 * 9.81, 1e-12);
  EXPECT_NEAR(read(hanging("", "", "ref=\"0.3\""), "a").unbalance_phase, -0.3, 1e-12);
  std::string upright = hanging("");
  upright.replace(upright.find("0 1 0"), 5, "0 0 1");
  EXPECT_TRUE(std::isnan(read(upright, "a").unbalance));
  EXPECT_THAT(read(upright, "a").notes, IsEmpty());
}

TEST(JointNumbers, OfAnMjcfSayWhatOfGravityAndSpringsWasNotTaken) {
  const auto noted = [](const std::string& xml) {
    const JointNumbers n = read(xml, "a");
    return n.notes.empty() ? "" : n.notes.back();
  };
  EXPECT_THAT(noted(hanging("", "<body name=\"hip\"><joint name=\"h\" axis=\"1 0 0\"/>")),
              HasSubstr("not taken: gravity, body hip above it turns"));
  EXPECT_THAT(noted(hanging("<body name=\"hand\"><joint name=\"w\"/></body>")),
              HasSubstr("not taken: gravity on a part of what hangs on the joint, as body hand moves"));
  EXPECT_THAT(noted(hanging("", "", "stiffness=\"0.05\" springref=\"0.2\"")),
              HasSubstr("not taken: the joint's stiffness 0.05 about springref 0.2"));
}

std::string driven(const std::string& actuators) {
  return "<mujoco><worldbody><body><inertial pos='0 0 0' mass='2' diaginertia='1e-3 1e-3 1e-3'/><joint "
         "name='a' type='slide'/></body></worldbody><actuator>" +
         actuators + "</actuator></mujoco>";
}

TEST(JointNumbers, OfAnMjcfKnowWhatItsActuatorsDoBesideTheirGear) {
  const JointNumbers n = read(
      driven("<general joint='a' gear='2' gainprm='3' biastype='affine' biasprm='0.5 0 0' dyntype='filter' "
             "dynprm='0.01' ctrllimited='true' ctrlrange='-4 4' forcelimited='true' forcerange='-6 6'/>"
             "<general joint='a' gainprm='0' biastype='affine' biasprm='-0.2 0 0'/>"
             "<motor joint='b' gear='7'/>"),
      "a");
  EXPECT_DOUBLE_EQ(n.torque_constant, 6.0);
  EXPECT_DOUBLE_EQ(n.weight, -2.0 * 9.81) << "along z";
  EXPECT_DOUBLE_EQ(n.constant_torque, 2.0 * 0.5 - 0.2 + n.weight);
  EXPECT_DOUBLE_EQ(n.lag, 0.01);
  EXPECT_DOUBLE_EQ(n.input_limit, 2.0) << "by the force";
  EXPECT_THAT(n.notes, IsEmpty());
  const JointNumbers free = read(driven("<motor joint='a' ctrllimited='false' ctrlrange='-4 4'/>"), "a");
  EXPECT_EQ(free.input_limit, kInfinity);
  const JointNumbers shared = read("<mujoco><default><general gear='50' ctrlrange='-3 3'/></default>" +
                                       driven("<motor joint='a'/>").substr(8),
                                   "a");
  EXPECT_DOUBLE_EQ(shared.torque_constant, 50.0) << "one default for actuators of every kind";
  EXPECT_DOUBLE_EQ(shared.input_limit, 3.0);
  EXPECT_EQ(free.lag, 0.0);
}

TEST(JointNumbers, OfAnMjcfSayWhatOfItsActuatorsWasNotTaken) {
  const auto noted = [](const std::string& actuators) {
    const JointNumbers n = read(driven(actuators), "a");
    return n.notes.empty() ? "" : n.notes.back();
  };
  EXPECT_THAT(noted("<general joint='a' biastype='affine' biasprm='0.1 -3 0'/>"),
              HasSubstr("bias that is no constant torque"));
  EXPECT_THAT(noted("<general joint='a' dyntype='integrator'/>"), HasSubstr("(dyntype integrator)"));
  EXPECT_THAT(noted("<motor joint='a' ctrlrange='0 4'/>"), HasSubstr("ctrlrange 0 to 4, which is not alike"));
  EXPECT_THAT(noted("<motor joint='a'/><motor joint='a' gear='2'/>"),
              HasSubstr("a further actuator of the joint, a motor"));
  EXPECT_THAT(noted("<motor joint='a' gear='-3'/>"), HasSubstr("-3 per unit of control"));
  const JointNumbers turned = read(driven("<position joint='a' kp='8' gear='-2' forcerange='-3 3'/>"), "a");
  EXPECT_DOUBLE_EQ(turned.servo->gain, 32.0);
  EXPECT_DOUBLE_EQ(turned.servo->saturation, 6.0);
  EXPECT_EQ(read(driven("<velocity joint='a' gear='-1'/>"), "a").servo->saturation, kInfinity);
}

TEST(JointNumbers, OfAUrdfAreItsDynamicsAndTheLinkAboutTheAxis) {
  const std::string xml =
      R"(<robot name="r"><link name="base"/><link name="arm"><inertial><origin xyz="0.1 0 0"/>
    <mass value="2"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.003"/></inertial></link>
    <joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="1" effort="5" velocity="3"/><dynamics damping="0.2" friction="0.3"/></joint></robot>)";
  const JointNumbers n = read(xml, "elbow");
  EXPECT_DOUBLE_EQ(n.inertia, 0.003 + 2.0 * 0.01);
  EXPECT_DOUBLE_EQ(n.damping, 0.2);
  EXPECT_DOUBLE_EQ(n.friction, 0.3);
  EXPECT_DOUBLE_EQ(n.torque_constant, 1.0);
  EXPECT_FALSE(n.slides);
  EXPECT_THAT(n.notes.back(), HasSubstr("not taken: gravity on the link, at most 1.96 N m"));
}

/// An MJCF of one joint whose file has 3 lines.
std::string one_joint(const std::string& joint, const std::string& inertial = "mass='1' diaginertia='1 1 1'",
                      const std::string& more = "") {
  return "<mujoco><worldbody><body name='arm'>\n<inertial pos='0 0 0' " + inertial +
         "/>\n<joint name='elbow' " + joint + "/>" + more + "</body></worldbody></mujoco>";
}

/// A URDF of one joint and its link.
std::string one_link(const std::string& joint, const std::string& axis = "0 0 1",
                     const std::string& mass = "1", const std::string& ixx = "1") {
  return "<robot name='r'><link name='arm'><inertial>\n<mass value='" + mass + "'/><inertia ixx='" + ixx +
         "' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\n<joint name='elbow' " + joint +
         "><axis xyz='" + axis + "'/><child link='arm'/></joint></robot>";
}

TEST(JointNumbers, NoSimulatorTakesAreRefusedWithNameAndLine) {
  for (const auto& [xml, said] : {
           std::pair(one_joint("armature='-0.01'"),
                     ":3: armature of joint 'elbow' is -0.01, expected 0 or more"),
           std::pair(one_joint("damping='-1'"), ":3: damping of joint 'elbow' is -1, expected 0 or more"),
           std::pair(one_joint("", "mass='-1' diaginertia='1 1 1'"), ":2: mass of body 'arm' is -1"),
           std::pair(one_joint("", "mass='1' diaginertia='1 1 -1'"), ":2: diaginertia of body 'arm' is -1"),
           std::pair(one_joint("", "mass='1' fullinertia='1 -2 1 0 0 0'"),
                     ":2: fullinertia of body 'arm' is -2"),
           std::pair(one_joint("type='ball'"),
                     ":3: joint 'elbow' is of type 'ball', expected hinge or slide"),
           std::pair(one_joint("type='foo'"), "is of type 'foo'"),
           std::pair(one_joint("axis='0 0 0'"), ":3: axis of joint 'elbow' is 0 0 0, expected a direction"),
           std::pair(one_joint("", "mass='1' diaginertia='1 1 1'", "\n<joint name='elbow' armature='0.5'/>"),
                     ":4: joint 'elbow' is there twice, expected each name once"),
           std::pair(one_link("type='fixed'"),
                     ":3: joint 'elbow' is of type 'fixed', expected revolute or continuous or prismatic"),
           std::pair(one_link("type='planar'"), "is of type 'planar'"),
           std::pair(one_link(""), "is of type ''"),
           std::pair(one_link("type='revolute'", "0 0 0"), ":3: axis of joint 'elbow' is 0 0 0"),
           std::pair(one_link("type='revolute'", "0 0 1", "-1"), ":2: mass of link 'arm' is -1"),
           std::pair(one_link("type='revolute'", "0 0 1", "1", "-3"), ":2: ixx of link 'arm' is -3"),
           std::pair(one_link("type='revolute'/><joint name='elbow' type='revolute'"),
                     ":3: joint 'elbow' is there twice"),
       })
    EXPECT_THAT(refused(xml, "elbow"), HasSubstr(said));
}

TEST(JointNumbers, OfATreeThatIsTooDeepSaySo) {
  std::string deep = one_joint("armature='0.01'"), open, close;
  for (int i = 0; i < 120; ++i) open += "<body>", close += "</body>";
  deep.insert(deep.find("<body name"), open);
  deep.insert(deep.find("</worldbody>"), close);
  EXPECT_THAT(refused(deep, "elbow"), HasSubstr("is nested too deep, expected at most 100 elements"));
}

TEST(JointNumbers, TakeTheTypeOfAJointFromItsClass) {
  const std::string xml =
      "<mujoco><default><joint type='slide'/></default><worldbody><body><inertial pos='0.1 0 0' mass='2' "
      "diaginertia='1 1 1'/><joint name='elbow'/></body></worldbody></mujoco>";
  EXPECT_TRUE(read(xml, "elbow").slides);
  EXPECT_DOUBLE_EQ(read(xml, "elbow").inertia, 2.0);
}

TEST(JointNumbers, AreRefusedWithWhatWasExpected) {
  EXPECT_THAT(refused("<mujoco><worldbody><body><joint name=\"hip\"/></body></worldbody></mujoco>", "knee"),
              HasSubstr("has no joint 'knee', expected one of: hip"));
  EXPECT_THAT(refused("<mujoco/>", "knee"), HasSubstr("expected one of: none"));
  EXPECT_THAT(refused("<sdf/>", "knee"), HasSubstr("begins with <sdf>, expected <mujoco> or <robot>"));
  EXPECT_THAT(refused("no XML", "knee"), HasSubstr("cannot be read as XML"));
  EXPECT_THAT(refusal([] { joint_numbers("/nowhere/robot.xml", "knee"); }),
              HasSubstr("/nowhere/robot.xml: there is no such file, expected an MJCF or URDF"));
  EXPECT_THAT(
      refused("<mujoco><worldbody><body><joint name=\"a\" damping=\"soft\"/></body></worldbody></mujoco>",
              "a"),
      HasSubstr("expected numbers"));
}

}  // namespace
}  // namespace gapscope
