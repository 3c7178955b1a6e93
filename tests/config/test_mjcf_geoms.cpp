// Bodies of which geoms tell the mass, against MuJoCo itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>

#include "config/joint_numbers.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFile;

struct Compiled {
  double inertia = 0.0;         ///< about the joint's axis [kg m²]
  double holds_at_angle = 0.0;  ///< [N m]
};

constexpr double kAngle = 0.7;

Compiled by_mujoco(const std::string& path) {
  char problem[1000] = "";
  mjModel* const model = mj_loadXML(path.c_str(), nullptr, problem, sizeof problem);
  if (model == nullptr) throw std::runtime_error(problem);
  mjData* const data = mj_makeData(model);
  data->qpos[0] = kAngle;
  mj_forward(model, data);
  double inertia = 0.0;
  mj_fullM(model, &inertia, data->qM);  // (1 × 1)
  const Compiled found{inertia, data->qfrc_bias[0]};
  mj_deleteData(data), mj_deleteModel(model);
  return found;
}

std::string model(const std::string& in_body, const std::string& head = "") {
  return "<mujoco>" + head +
         "<worldbody><body name=\"link\" euler=\"0 30 10\">"
         "<joint name=\"a\" axis=\"0.2 1 0.4\" pos=\"0.01 0 0.02\" armature=\"2e-3\"/>\n" +
         in_body + "</body></worldbody></mujoco>";
}

TEST(MjcfGeoms, GiveABodyTheMassAndTheInertiaOfMuJoCo) {
  const struct {
    const char* name;
    std::string xml;
  } cases[] = {
      {"a sphere with its mass", model(R"(<geom type="sphere" pos="0 0 -0.12" size="0.001" mass="0.4"/>)")},
      {"no type, no density", model(R"(<geom pos="0 0.03 -0.12" size="0.02"/>)")},
      {"box",
       model(R"(<geom type="box" pos="0 0 -0.1" euler="20 -50 10" size="0.01 0.02 0.1" density="700"/>)")},
      {"cylinder", model(R"(<geom type="cylinder" pos="0.1 0 0" quat="1 2 0 3" size="0.03 0.1" mass="2"/>)")},
      {"capsule", model(R"(<geom type="capsule" pos="0.1 0 0" axisangle="1 2 0 40" size="0.03 0.1"/>)")},
      {"ellipsoid", model(R"(<geom type="ellipsoid" zaxis="1 0 1" size="0.03 0.1 0.05" mass="0.2"/>)")},
      {"capsule from to", model(R"(<geom type="capsule" fromto="0 0.01 0 0.05 0 -0.2" size="0.03"/>)")},
      {"cylinder from to",
       model(R"(<geom type="cylinder" fromto="0 0.01 0 0 0 -0.2" size="0.03" mass="1"/>)")},
      {"box from to", model(R"(<geom type="box" fromto="0 0.01 0 0.05 0 -0.2" size="0.03"/>)")},
      {"several", model("<geom size=\"0.03\"/><geom type=\"box\" pos=\"0 0 -0.2\" size=\"0.1 0.02 0.03\"/>"
                        "<geom type=\"box\" size=\"1 1 1\" mass=\"0\"/>")},
      {"by a class",
       model(R"(<geom class="arm" pos="0 0 -0.1"/>)",
             R"(<default><default class="arm"><geom type="capsule" euler="0 40 0" size="0.02 0.1"
                              density="500"/></default></default>)")},
      {"by groups", model("<geom size=\"0.03\" pos=\"0.1 0 0\" group=\"2\"/><geom size=\"0.1\" group=\"1\"/>",
                          R"(<compiler inertiagrouprange="2 3"/>)")},
      {"geoms before the inertial",
       model(R"(<inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/><geom size="0.03" pos="0.1 0 0"/>)",
             R"(<compiler inertiafromgeom="true"/>)")},
      {"an inertial before geoms",
       model(R"(<inertial pos="0 0 0.1" mass="9" diaginertia="1 1 1"/><geom size="0.03"/>)")},
      {"fixed to it", model(R"(<geom size="0.03"/><body pos="0 0.1 -0.2" euler="0 90 0"><geom
                               type="box" size="0.02 0.03 0.1" pos="0.1 0 0"/></body>)")},
  };
  for (const auto& c : cases) {
    const TemporaryFile file(c.xml, "model.xml");
    const Compiled truth = by_mujoco(file.path());
    const JointNumbers n = joint_numbers(file.path(), "a");
    EXPECT_NEAR(n.inertia, truth.inertia, 1e-9 * truth.inertia) << c.name;
    EXPECT_NEAR(n.unbalance * std::sin(kAngle + n.unbalance_phase), truth.holds_at_angle, 1e-9) << c.name;
    EXPECT_THAT(n.notes, IsEmpty()) << c.name;
  }
}

TEST(MjcfGeoms, ThatStandInAFrameAreTurnedWithIt) {
  const std::string flat = R"(<geom type="box" pos="0 0.1 0" size="0.01 0.02 0.1"/>)";
  const std::string turned = R"(<geom type="box" pos="-0.1 0 0" euler="0 0 90" size="0.01 0.02 0.1"/>)";
  const TemporaryFile in_frame(model("<frame euler=\"0 0 90\">" + flat + "</frame>"), "frame.xml");
  const TemporaryFile alone(model(turned), "alone.xml");
  EXPECT_NEAR(joint_numbers(in_frame.path(), "a").inertia, joint_numbers(alone.path(), "a").inertia, 1e-12);
}

TEST(MjcfGeoms, ThatAreNotReadAreToldWithFileAndLineAndWhatHelps) {
  const TemporaryFile file(model(R"(<geom type="mesh" mesh="link"/>)"), "model.xml");
  const JointNumbers n = joint_numbers(file.path(), "a");
  EXPECT_DOUBLE_EQ(n.inertia, 2e-3);
  EXPECT_THAT(n.notes.at(0), HasSubstr("model.xml:2: the mass of body link is that of a mesh"));
  EXPECT_THAT(n.notes.at(0), HasSubstr("write an <inertial>"));
  EXPECT_THAT(n.notes.at(0), HasSubstr("mj_saveLastXML"));
  EXPECT_THAT(n.notes.at(1), HasSubstr("only the armature"));
  EXPECT_THAT(n.notes.at(2), HasSubstr("not taken: gravity"));
}

TEST(MjcfGeoms, WithTooFewSizesAreRefused) {
  const TemporaryFile file(model(R"(<geom type="box" size="0.1"/>)"), "model.xml");
  try {
    joint_numbers(file.path(), "a");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("model.xml:2: has a box with 1 sizes, expected 3 above 0"));
  }
}

}  // namespace
}  // namespace gapscope
