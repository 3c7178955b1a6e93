// What a controller made of target and position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gapscope/recording/controller.h"
#include "gapscope/recording/recording_file.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

const std::vector<double> kTimes = {0.0, 0.1, 0.2, 0.3, 0.4};

std::vector<double> input_of(const DriveController& c, const std::vector<double>& target,
                             const std::vector<double>& x) {
  return commanded_input(c, {kTimes, target, x, std::vector<double>(kTimes.size(), 1.0)});
}

TEST(DriveController, HoldsItsOutputFromRowToRow) {
  DriveController c;
  c.gain = 2.0;
  const std::vector<double> target = {1.0, 1.0, 1.0, 0.0, 0.0}, x = {0.0, 0.25, 0.5, 0.5, 0.25};
  EXPECT_THAT(input_of(c, target, x), ElementsAre(2.0, 1.5, 1.0, -1.0, -0.5));
}

TEST(DriveController, ActsLater) {
  DriveController c;
  c.gain = 2.0, c.delay = 0.025;
  const std::vector<double> target = {1.0, 1.0, 1.0, 0.0, 0.0}, x = {0.0, 0.25, 0.5, 0.5, 0.25};
  // A quarter of each interval still has the output before.
  EXPECT_THAT(input_of(c, target, x),
              Pointwise(DoubleNear(1e-12), {2.0, 0.25 * 2.0 + 0.75 * 1.5, 0.25 * 1.5 + 0.75 * 1.0,
                                            0.25 * 1.0 - 0.75 * 1.0, -0.25 * 1.0 - 0.75 * 0.5}));
}

Recording commanded_at(const std::vector<double>& times) {
  Recording r;
  r.dt = 0.1, r.x1 = {0.0, 0.25, 0.5, 0.5, 0.25};
  r.command = std::make_shared<CommandRows>(
      CommandRows{times, {1.0, 1.0, 1.0, 0.0, 0.0}, r.x1, std::vector<double>(5, 1.0)});
  return r;
}

/// The mean of an interval says when a drive has which speed, but not where it is then.
TEST(DriveController, LeavesWhatItSentBesideTheMeans) {
  DriveController c;
  c.gain = 2.0, c.delay = 0.025;
  Recording r = commanded_at(kTimes);
  command_by(c, r);
  EXPECT_EQ(r.u, commanded_input(c, *r.command));
  EXPECT_THAT(r.sent, ElementsAre(2.0, 1.5, 1.0, -1.0, -0.5));
  EXPECT_EQ(r.delay, 0.025);
  const Recording later = part(r, 2, 3);
  const MotorTrace same = part(r.motor_trace(), 2, 3);
  EXPECT_THAT(later.sent, ElementsAre(1.0, -1.0, -0.5));
  EXPECT_THAT(same.sent, ElementsAre(1.0, -1.0, -0.5));
  EXPECT_EQ(later.delay, 0.025);
  EXPECT_EQ(same.delay, 0.025);
}

TEST(DriveController, LeavesTheMeansAloneWhereUpdatesAreAtNoRow) {
  DriveController c;
  c.gain = 2.0, c.delay = 0.025, c.rate = 25.0;
  Recording r = commanded_at(kTimes);
  command_by(c, r);
  EXPECT_TRUE(r.sent.empty());
  EXPECT_EQ(r.delay, 0.0);
  c.rate = 10.0, c.delay = 0.0;
  command_by(c, r);
  EXPECT_TRUE(r.sent.empty());
  c.delay = 0.025;
  command_by(c, r);
  EXPECT_FALSE(r.sent.empty());
}

TEST(DriveController, MayHaveHadAnotherGain) {
  DriveController c;
  c.gain = 2.0, c.integral = 1.0;
  CommandRows rows = {
      kTimes, {1.0, 1.0, 1.0, 0.0, 0.0}, {0.0, 0.25, 0.5, 0.5, 0.25}, std::vector<double>(5, 1.0)};
  rows.gain_times = 0.25;
  const std::vector<double> quarter = commanded_input(c, rows);
  c.gain = 0.5, rows.gain_times = 1.0;
  EXPECT_EQ(quarter, commanded_input(c, rows));
}

/// Between 0.2 and 0.6 s three rows are missing: the input is the mean of a line from there to the next one.
TEST(DriveController, IsDrawnOverLostRowsWhereTheyAreBridged) {
  DriveController c;
  c.gain = 1.0;
  CommandRows rows = {
      {0.0, 0.1, 0.2, 0.6, 0.7}, {1, 1, 1, 5, 5}, {0, 0, 0, 0, 0}, std::vector<double>(5, 1.0)};
  EXPECT_THAT(commanded_input(c, rows), ElementsAre(1, 1, 1, 5, 5));
  rows.bridged = {{2, 3}};
  EXPECT_THAT(commanded_input(c, rows), ElementsAre(1, 1, 1 + 4 * 3.0 / 8.0, 5, 5));
  EXPECT_THAT(commanded_input(c, rows, 1, 4), ElementsAre(1, 1 + 4 * 3.0 / 8.0, 5, 5));
  EXPECT_THAT(commanded_input(c, rows, 3, 2), ElementsAre(5, 5));
}

TEST(DriveController, UpdatesAtItsOwnRateBetweenTheRows) {
  DriveController c;
  c.gain = 1.0, c.rate = 20.0;  // at 0, 0.05, 0.1, …; the position is linear between the rows
  const std::vector<double> target(5, 1.0), x = {0.0, 0.2, 0.4, 0.6, 0.8};
  const std::vector<double> u = input_of(c, target, x);
  EXPECT_NEAR(u[0], 0.5 * (1.0 + 0.9), 1e-9);
  EXPECT_NEAR(u[2], 0.5 * (0.6 + 0.5), 1e-9);
  c.rate = 5.0;  // slower than the rows: held over two of them
  EXPECT_THAT(input_of(c, target, x), Pointwise(DoubleNear(1e-9), {1.0, 1.0, 0.6, 0.6, 0.2}));
}

TEST(DriveController, DampsIntegratesAndLimits) {
  const std::vector<double> target(5, 1.0), x = {0.0, 0.2, 0.4, 0.6, 0.8};
  DriveController c;
  c.gain = 0.0, c.derivative = 0.5;
  EXPECT_THAT(input_of(c, target, x), Pointwise(DoubleNear(1e-9), {0.0, -1.0, -1.0, -1.0, -1.0}));
  c.derivative = 0.0, c.integral = 10.0;
  EXPECT_THAT(input_of(c, target, x), Pointwise(DoubleNear(1e-9), {0.0, 0.8, 1.4, 1.8, 2.0}));
  c.saturation = 1.0;  // the sum rests at 0.08
  EXPECT_THAT(input_of(c, target, x), Pointwise(DoubleNear(1e-9), {0.0, 0.8, 1.0, 1.0, 1.0}));
  c = {};
  c.gain = 1.0, c.dead_band = 0.3;
  EXPECT_THAT(input_of(c, target, x), Pointwise(DoubleNear(1e-9), {1.0, 0.8, 0.6, 0.4, 0.0}));
}

/// A recording with both, in units of a drive: a duty, the voltage of its supply.
std::string file_with(const char* header, bool input) {
  std::string text = std::string(header) + "\n";
  for (int i = 0; i < 60; ++i) {
    const double t = 0.01 * i, goal = std::sin(3.0 * t), x = 0.9 * std::sin(3.0 * t - 0.1),
                 volts = 7.0 + 0.1 * (i % 2);
    text += std::to_string(t) + "," + (input ? std::to_string(0.5 * (goal - x)) + "," : "") +
            std::to_string(goal) + "," + std::to_string(x) + "," + std::to_string(volts) + "\n";
  }
  return text;
}

TEST(TargetColumn, TakesThePlaceOfTheInput) {
  const testing::TemporaryFile file(file_with("t,goal,x1,volts", false));
  ReadOptions options;
  options.columns.target = "goal", options.columns.voltage = "volts",
  options.columns.input_column = InputColumn::kNone;
  options.controller = DriveController{};
  options.controller->gain = 0.5;
  const Recording r = read_recording(file.path(), options);
  EXPECT_NEAR(r.u[10], 0.5 * (std::sin(0.3) - 0.9 * std::sin(0.2)) * 7.0, 1e-5);
  EXPECT_NEAR(r.u[11], 0.5 * (std::sin(0.33) - 0.9 * std::sin(0.23)) * 7.1, 1e-5);
}

TEST(TargetColumn, BesideTheInputTellsOfTheController) {
  const testing::TemporaryFile file(file_with("t,u,goal,x1,volts", true));
  ReadOptions options;
  options.columns.target = "goal", options.columns.voltage = "volts";
  options.controller = DriveController{};
  options.controller->gain = 0.25;
  const auto compared = compare_with_controller(file.path(), options);
  ASSERT_TRUE(compared);
  EXPECT_NEAR(compared->scale, 2.0, 1e-4);
  EXPECT_LT(compared->left, 1e-4);
  EXPECT_NEAR(read_recording(file.path(), options).u[10], 0.5 * (std::sin(0.3) - 0.9 * std::sin(0.2)) * 7.0,
              1e-5)
      << "what was recorded is taken";
}

}  // namespace
}  // namespace gapscope
