// A machine with several axes in one file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"
#include "inspection/rows.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

/// Two axes that move alike, the second one by half as much.
std::string two_axes() {
  const testing::Rows rows = testing::rig();
  std::string text = "t,hip_u,hip_q,knee_u,knee_q\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i)
    text += fmt::format("{},{},{},{},{}\n", rows.t[i], rows.u[i], rows.x1[i], rows.u[i], 0.5 * rows.x1[i]);
  return text;
}

TEST(Axis, NoneIsWrittenAboveTheMachinesFolderOrOverAnother) {
  Workplace place;
  place.file("up.csv", "t,.._u,.._q,a b_u,a b_q,a_b_u,a_b_q\n0,0,0,0,0,0,0\n");
  place.file("up.yaml",
             "recording: {file: up.csv, columns: {input: \"{axis}_u\", position: \"{axis}_q\"}}\n"
             "model: {parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172}}\n");
  const auto before = place.content();
  for (const char* command : {"run up.yaml --axis .. -o out/deep", "run up.yaml --axis all -o out/deep"}) {
    const auto refused = place.run(command);
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr("can have no folder")) << command;
  }
  EXPECT_EQ(place.content(), before);
  place.file("up.csv", "t,a b_u,a b_q,a_b_u,a_b_q\n0,0,0,0,0\n");
  const auto refused = place.run("run up.yaml --axis all -o out");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("two axes would share the folder a_b"));
}

TEST(Axis, EachHasAReportAndAllHaveOneTable) {
  Workplace place;
  place.file("robot.csv", two_axes());
  place.file("robot.yaml",
             "recording: {file: robot.csv, columns: {input: \"{axis}_u\", position: \"{axis}_q\"}}\n"
             "model: {parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172}}\n");
  const auto all = place.run("detect robot.yaml --axis all -o out");
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_TRUE(place.content().count("out/hip/result.json") && place.content().count("out/knee/result.json"));
  EXPECT_THAT(all.out,
              HasSubstr("hip                 knee                mean        spread      of a fit\n"));
  EXPECT_THAT(all.out, HasSubstr("\ngap (free)  "));
  EXPECT_THAT(place.run("compare out/hip out/knee --spread").out, HasSubstr("gap (free)"));
  const auto one = place.run("detect robot.yaml --axis knee -o single");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, Not(HasSubstr("spread")));
  EXPECT_EQ(testing::text_of(place.folder() / "single/knee/result.json"),
            testing::text_of(place.folder() / "out/knee/result.json"));
  const auto none = place.run("detect robot.yaml -o none");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("has several axes"));
}

TEST(Axis, CheckAndInitTakeOneOrAll) {
  Workplace place;
  place.file("robot.csv", two_axes());
  const std::string named = "robot.csv --position {axis}_q --input {axis}_u --axis ";
  const auto check = place.run("check " + named + "all");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("axis        knee\n"));
  EXPECT_EQ(place.run("init " + named + "all").status, 0);
  const std::string yaml = testing::text_of(place.folder() / "robot_knee.yaml");
  EXPECT_THAT(yaml, HasSubstr("\nname: robot_knee"));
  EXPECT_THAT(yaml, HasSubstr("position: \"knee_q\""));
  EXPECT_THAT(place.run("check robot.csv --axis knee --position knee_q --input knee_u").err,
              HasSubstr("expected {axis} in the names of the columns"));
}

}  // namespace
}  // namespace gapscope
