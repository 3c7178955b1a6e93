// Bodies that are turned, against MuJoCo itself; files that a model includes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "config/joint_numbers.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFile;

constexpr const char* kLink =
    R"(<inertial pos="0.02 0.01 -0.05" mass="0.3" euler="20 -50 10" diaginertia="1e-3 2e-3 2.5e-3"/>)";

/// A joint "a" in a body that is turned so, within another one.
std::string turned(const std::string& compiler, const std::string& outer, const std::string& inner,
                   const std::string& behind = "") {
  return "<mujoco><compiler " + compiler + "/><worldbody><body " + outer + ">" +
         R"(<inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/><body )" + inner + ">" +
         R"(<joint name="a" axis="0.2 1 0.4" pos="0.01 0 0.02" armature="2e-3"/>)" + kLink + behind +
         "</body></body></worldbody></mujoco>";
}

class Engine {
 public:
  explicit Engine(const std::string& path) {
    char problem[1000] = "";
    model_ = mj_loadXML(path.c_str(), nullptr, problem, sizeof problem);
    if (model_ == nullptr) throw std::runtime_error(problem);
    data_ = mj_makeData(model_);
    joint_ = mj_name2id(model_, mjOBJ_JOINT, "a");
  }
  ~Engine() { mj_deleteData(data_), mj_deleteModel(model_); }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// What holds the joint at an angle against gravity [N m].
  double holds(double angle) {
    data_->qpos[model_->jnt_qposadr[joint_]] = angle;
    mj_forward(model_, data_);
    return data_->qfrc_bias[model_->jnt_dofadr[joint_]];
  }
  /// Of all that turns with the joint [kg m²].
  double inertia() {
    mj_forward(model_, data_);
    std::vector<double> all(static_cast<std::size_t>(model_->nv * model_->nv));
    mj_fullM(model_, all.data(), data_->qM);
    const int dof = model_->jnt_dofadr[joint_];
    return all[static_cast<std::size_t>(dof * model_->nv + dof)];
  }

 private:
  mjModel* model_;
  mjData* data_;
  int joint_;
};

TEST(MjcfBodies, ThatAreTurnedHaveTheGravityAndTheInertiaOfMuJoCo) {
  const std::string degrees = "angle=\"degree\"", radians = "angle=\"radian\"";
  const std::string behind =
      std::string("<body pos=\"0.03 0 -0.1\" axisangle=\"1 2 0 40\">") + kLink + "</body>";
  const struct {
    const char* name;
    std::string xml;
  } cases[] = {
      {"quat", turned(degrees, "quat=\"0.5 0.2 -0.4 2\"", "")},
      {"euler", turned(degrees, "euler=\"30 -40 70\"", "pos=\"1 2 3\" euler=\"10 20 30\"")},
      {"eulerseq", turned("eulerseq=\"zYx\" angle=\"radian\"", "euler=\"0.3 -0.4 0.7\"", "")},
      {"axisangle", turned(radians, "axisangle=\"1 2 -1 0.8\"", "axisangle=\"0 3 0 -0.5\"")},
      {"xyaxes", turned(degrees, "xyaxes=\"1 0.2 0 0.3 1 0.4\"", "")},
      {"zaxis", turned(degrees, "zaxis=\"1 -0.5 0.4\"", "zaxis=\"0 0 -2\"")},
      {"a body that is fixed to it", turned(degrees, "euler=\"30 0 0\"", "", behind)},
      {"a joint about the vertical above it",
       turned(degrees, "euler=\"0 0 50\"><joint axis=\"0 0 1\" name=\"yaw\"/", "euler=\"70 0 0\"")},
  };
  for (const auto& c : cases) {
    const TemporaryFile file(c.xml, "model.xml");
    Engine engine(file.path());
    const JointNumbers n = joint_numbers(file.path(), "a");
    for (const double angle : {-2.0, 0.0, 0.7, 1.9})
      EXPECT_NEAR(n.unbalance * std::sin(angle + n.unbalance_phase), engine.holds(angle), 1e-9) << c.name;
    EXPECT_NEAR(n.inertia, engine.inertia(), 1e-12) << c.name;
  }
}

TEST(MjcfBodies, UnderAJointThatTurnsThemOutOfTheVerticalHaveNoGravity) {
  for (const char* above : {"<joint axis=\"0 1 0\"/", "<joint type=\"ball\"/"}) {
    const TemporaryFile file(turned("angle=\"degree\"", std::string("name=\"hip\">") + above, ""), "m.xml");
    const JointNumbers n = joint_numbers(file.path(), "a");
    EXPECT_TRUE(std::isnan(n.unbalance));
    EXPECT_THAT(n.notes.back(), HasSubstr("not taken: gravity, body hip above it turns"));
  }
}

std::string refused(const std::string& path) {
  try {
    joint_numbers(path, "a");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(MjcfBodies, ThatAreTurnedByNoRotationAreRefused) {
  const auto told = [](const std::string& outer) {
    return refused(TemporaryFile(turned("angle=\"degree\"", outer, ""), "m.xml").path());
  };
  EXPECT_THAT(told("quat=\"1 0 0\""), HasSubstr("m.xml:1: has quat='1 0 0', expected 4 numbers"));
  EXPECT_THAT(told("zaxis=\"0 0 0\""), HasSubstr("has zaxis='0 0 0', expected a direction"));
}

class Included : public ::testing::Test {
 protected:
  /// The joint of a robot in a scene, with its defaults and its actuator in files of their own.
  void SetUp() override {
    std::filesystem::create_directories(main_.folder() / "parts");
    put("parts/robot.xml",
        "<mujoco><include file=\"parts/defaults.xml\"/>\n<worldbody><body><inertial pos=\"0 0 -0.1\" mass=\"1\" "
        "diaginertia=\"1e-3 1e-3 1e-3\"/><joint name=\"a\" axis=\"0 1 0\"/></body></worldbody></mujoco>");
    put("parts/defaults.xml", "<mujoco><default><joint damping=\"0.2\"/></default></mujoco>");
    put("motor.xml", "<mujocoinclude><actuator><motor joint=\"a\" gear=\"3\"/></actuator></mujocoinclude>");
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(main_.folder() / name) << text;
  }
  std::string told(const std::string& text) const {
    put("scene.xml", text);
    return refused(main_.path());
  }

  const TemporaryFile main_{
      "<mujoco><include file=\"parts/robot.xml\"/><default><joint frictionloss=\"0.1\"/></default>"
      "<actuator/><include file=\"motor.xml\"/></mujoco>",
      "scene.xml"};
};

TEST_F(Included, FilesAreReadAsMuJoCoReadsThem) {
  const JointNumbers n = joint_numbers(main_.path(), "a");
  Engine engine(main_.path());
  EXPECT_DOUBLE_EQ(n.damping, 0.2);
  EXPECT_DOUBLE_EQ(n.friction, 0.1);
  EXPECT_DOUBLE_EQ(n.torque_constant, 3.0);
  EXPECT_NEAR(n.unbalance, 0.1 * 9.81, 1e-12);
  EXPECT_NEAR(n.unbalance * std::sin(0.4), engine.holds(0.4), 1e-9);
  EXPECT_THAT(n.notes, IsEmpty());
}

TEST_F(Included, FilesThatCannotBeReadAreRefusedWithFileAndLine) {
  EXPECT_THAT(told("<mujoco>\n<include/></mujoco>"),
              HasSubstr("scene.xml:2: has an <include> without file="));
  EXPECT_THAT(told("<mujoco>\n<include file=\"none.xml\"/></mujoco>"),
              HasSubstr("scene.xml:2: includes 'none.xml', which is no file"));
  EXPECT_THAT(told("<mujoco><include file=\"../other.xml\"/></mujoco>"),
              HasSubstr("scene.xml:1: includes '../other.xml', expected a file in the folder of the model"));
  EXPECT_THAT(told("<mujoco><include file=\"/dev/zero\"/></mujoco>"),
              HasSubstr("expected a file in the folder"));
  std::filesystem::create_symlink("/etc/passwd", main_.folder() / "link.xml");
  EXPECT_THAT(told("<mujoco><include file=\"link.xml\"/></mujoco>"),
              HasSubstr("expected a file in the folder"));
  put("text.xml", "no XML");
  EXPECT_THAT(told("<mujoco><include file=\"text.xml\"/></mujoco>"), HasSubstr("cannot be read as XML"));
}

TEST_F(Included, FilesMayNeitherGoInCirclesNorWithoutEnd) {
  put("ring.xml", "<mujoco>\n\n<include file=\"ring.xml\"/></mujoco>");
  EXPECT_THAT(told("<mujoco><include file=\"ring.xml\"/></mujoco>"),
              HasSubstr("ring.xml:3: includes 'ring.xml', which is there already, expected each file once"));
  EXPECT_THAT(told("<mujoco><include file=\"scene.xml\"/></mujoco>"), HasSubstr("which is there already"));
  for (int i = 0; i < 20; ++i)
    put("deep" + std::to_string(i) + ".xml",
        "<mujoco><include file=\"deep" + std::to_string(i + 1) + ".xml\"/></mujoco>");
  EXPECT_THAT(told("<mujoco><include file=\"deep0.xml\"/></mujoco>"),
              HasSubstr("deep15.xml:1: includes 'deep16.xml', expected at most 16 files one in the other"));
}

}  // namespace
}  // namespace gapscope
