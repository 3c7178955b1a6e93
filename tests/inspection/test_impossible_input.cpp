// An input that cannot be what drives the motor, and where an arm hangs.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gapscope/inspection/inspection.h"
#include "inspection/inspected.h"

namespace gapscope {
namespace {

using test::finding;
using test::inspected;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Rows;
using testing::TemporaryFile;

/// An arm that hangs down at `hangs`, 8 s at 500 Hz, 14 bit: u is its torque [N m].
Rows hanging(double hangs, double wide = 1.0) {
  const double count = 2.0 * 3.14159265358979323846 / 16384.0;
  Rows r;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.002 * i, w = wide * (3.6 * std::cos(3.0 * t) + 2.8 * std::cos(7.0 * t));
    const double a = wide * (-10.8 * std::sin(3.0 * t) - 19.6 * std::sin(7.0 * t));
    const double x = hangs + wide * (1.2 * std::sin(3.0 * t) + 0.4 * std::sin(7.0 * t));
    r.t.push_back(t), r.x1.push_back(count * std::round(x / count));
    r.u.push_back(0.02 * a + 0.03 * w + 0.7 * std::sin(x - hangs));
  }
  return r;
}

/// The same motion with the goal that a servo followed 10 ms later in the input's place, times a factor.
Rows with_goal(double factor) {
  Rows r = hanging(0.0);
  for (std::size_t i = 0; i < r.u.size(); ++i) r.u[i] = factor * r.x1[std::min(i + 5, r.u.size() - 1)];
  return r;
}

TEST(ImpossibleInput, AGoalIsSaidToBeOneInTheUnitOfThePosition) {
  const Finding f = finding(inspected(with_goal(1.0)), kInputRule);
  EXPECT_EQ(f.severity, Severity::kSpoils);
  EXPECT_THAT(f.found, HasSubstr("a commanded position, no torque, current or duty?"));
  EXPECT_THAT(f.advice, HasSubstr("--target"));
  ReadOptions degrees;
  degrees.columns.scales.position = {3.14159265358979323846, 180.0};
  Rows both = with_goal(180.0 / 3.14159265358979323846);
  for (double& x : both.x1) x *= 180.0 / 3.14159265358979323846;
  EXPECT_THAT(finding(inspected(both, degrees), kInputRule).found, HasSubstr("a commanded position"));
}

TEST(ImpossibleInput, ATorqueIsNone) {
  EXPECT_NE(finding(inspected(hanging(0.0)), kInputRule).severity, Severity::kSpoils);
  EXPECT_NE(finding(inspected(with_goal(5.0)), kInputRule).severity, Severity::kSpoils) << "a stiff spring";
}

/// Rows of a duty and its supply's 12 V.
std::string duty_csv(double times) {
  const Rows r = hanging(0.0);
  std::string csv = "t,u,x1,v\n";
  for (std::size_t i = 0; i < r.t.size(); ++i)
    csv += fmt::format("{},{},{},12\n", r.t[i], times * r.u[i], r.x1[i]);
  return csv;
}

TEST(ImpossibleInput, ADutyBeyondOneIsAskedForItsScale) {
  ReadOptions options;
  options.columns.voltage = "v";
  const TemporaryFile percent(duty_csv(60.0)), share(duty_csv(0.6));
  const Finding f = finding(inspect(percent.path(), options), kInputRule);
  EXPECT_TRUE(f.warned);
  EXPECT_THAT(f.found, HasSubstr("the duty that the voltage multiplies is up to"));
  EXPECT_THAT(f.advice, HasSubstr("--input-unit 0.01"));
  EXPECT_THAT(finding(inspect(share.path(), options), kInputRule).found, Not(HasSubstr("the duty")));
}

TEST(ImpossibleInput, AGainInUnitsOfTheFirmwareIsAskedFor) {
  ReadOptions options;
  options.columns.voltage = "v", options.columns.target = "u";
  options.columns.input_column = InputColumn::kNone;
  options.controller.emplace().gain = 400.0;
  const TemporaryFile file(duty_csv(1.0));
  EXPECT_THAT(finding(inspect(file.path(), options), kInputRule).advice, HasSubstr("units of the firmware"));
  options.controller->gain = 0.5;
  EXPECT_THAT(finding(inspect(file.path(), options), kInputRule).advice, Not(HasSubstr("firmware")));
}

TEST(ImpossibleInput, HundredsOfAmperesMayBeMilliamperes) {
  Rows rows = hanging(0.0);
  test::scale(rows.u, 1000.0);
  Inspection current = inspected(rows), other = inspected(rows);
  judge_for_unit("A", current), judge_for_unit("N m", other);
  EXPECT_TRUE(finding(current, kInputRule).warned);
  EXPECT_THAT(finding(current, kInputRule).advice, HasSubstr("--input-unit mA"));
  EXPECT_FALSE(finding(other, kInputRule).warned);
}

TEST(HangsAt, IsToldWhereTheRecordingShowsItAlikeInBothHalves) {
  EXPECT_NEAR(inspected(hanging(3.1)).facts.hangs_at, 3.1, 0.05);
  EXPECT_NEAR(inspected(hanging(0.0)).facts.hangs_at, 0.0, 0.05);
  EXPECT_TRUE(std::isnan(inspected(test::good()).facts.hangs_at)) << "nothing hangs on that one";
  Rows half = hanging(3.1);  // switched off in its second half
  for (std::size_t i = half.u.size() / 2; i < half.u.size(); ++i) half.u[i] = 0.0;
  EXPECT_TRUE(std::isnan(inspected(half).facts.hangs_at));
}

TEST(Sign, OfAnInputThatIsDrivenAsksForExchangedColumnsAsWell) {
  Rows turned = hanging(0.0);
  test::scale(turned.u, -1.0);
  EXPECT_THAT(finding(inspected(turned), "sign").advice,
              HasSubstr("the columns of u and x1 are exchanged: --input, --position"));
}

}  // namespace
}  // namespace gapscope
