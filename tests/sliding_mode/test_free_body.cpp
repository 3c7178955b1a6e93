#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "signals/signal_facts.h"
#include "sliding_mode/free_body.h"
#include "sliding_mode/hidden_gap.h"
#include "sliding_mode/test_drive.h"
#include "sliding_mode/visible_gap.h"

namespace gapscope::internal::sliding_mode {
namespace {

using independent_plant::Waveform;

TEST(FreeBody, ComesToRestWhereItsFrictionHoldsIt) {
  const FreeBody body{.drive = 1.0, .dry = 2.0};
  double x = 0.0, v = 1.0;
  for (int i = 0; i < 100; ++i) advance(body, 1.0, 0.03, x, v);
  EXPECT_NEAR(x, 0.5, 1e-12);  // v²/2(2 − 1)
  EXPECT_EQ(v, 0.0);
  advance(body, -3.0, 0.1, x, v);
  EXPECT_NEAR(v, -0.1, 1e-12) << "beyond it the torque moves it";
}

TEST(FreeBody, TurnsRoundWithinAnInterval) {
  double x = 0.0, v = 1.0;
  advance({.drive = 1.0}, -4.0, 0.5, x, v);
  EXPECT_NEAR(x, 0.0, 1e-12);
  EXPECT_NEAR(v, -1.0, 1e-12);
}

/// Three periods of that body under a sine, at 400 instants each.
FreeMotion motion_of(const FreeBody& body) {
  FreeMotion m{1.0 / 400.0, {}, {}, {{100, 499}, {500, 899}, {900, 1299}}};
  double x = 0.0, v = 0.0;
  for (int i = 0; i < 1300; ++i) {
    m.u.push_back(std::sin(2.0 * std::numbers::pi * i / 400.0));
    m.x.push_back(x);
    advance(body, m.u.back(), m.dt, x, v);
  }
  return m;
}

TEST(FreeBody, IsFoundInItsOwnMotion) {
  const FreeBody body{200.0, 20.0, 20.0, -3.0, 60.0, 1.0};
  const FollowedBody found =
      follow(motion_of(body), {150.0, 15.0, 10.0, 0.0, 10.0, 0.5}, FreeNumbers::kSticking);
  EXPECT_LT(found.left, 1e-9);
  EXPECT_NEAR(found.body.drive, body.drive, 1e-6);
  EXPECT_NEAR(found.body.constant, body.constant, 1e-6);
  EXPECT_NEAR(found.body.sticking, body.sticking, 1e-6);
  EXPECT_NEAR(found.body.fading, body.fading, 1e-6);
}

/// What no such body does: friction that pushes.
TEST(FreeBody, IsNeverDrivenByFriction) {
  const FollowedBody found =
      follow(motion_of({200.0, 0.0, -10.0}), {150.0, 3.0, 10.0}, FreeNumbers::kDriveAndFriction);
  EXPECT_EQ(found.body.dry, 0.0);
  EXPECT_EQ(found.body.sticking, 0.0);
  EXPECT_GE(found.body.viscous, 0.0);
  EXPECT_GT(found.left, 1e-3);
}

/// ẍ = 200 u − 30 ẋ − 4 sign(ẋ), in small steps, under a torque that vanishes at once and rises slowly the
/// other way: it arrives, rests and leaves again.
FreeMotion rest(double dry_while_it_arrives) {
  FreeMotion m{1e-3, {}, {}, {{255, 500}}};
  double x = 0.0, v = 0.0;
  for (int i = 0; i < 600; ++i) {
    m.u.push_back(i < 250 ? 0.1 : i < 350 ? 0.0 : -1e-3 * (i - 350));
    m.x.push_back(x);
    const double dry = i < 350 ? dry_while_it_arrives : 4.0;
    for (int k = 0; k < 100; ++k) {
      const double pushed = v + 1e-5 * (200.0 * m.u.back() - 30.0 * v);
      v = std::copysign(std::max(std::abs(pushed) - 1e-5 * dry, 0.0), pushed);
      x += 1e-5 * v;
    }
  }
  return m;
}

double squares_left(const FreeMotion& motion, const FreeBody& start = {150.0, 20.0, 0.0}) {
  return follow(motion, start, FreeNumbers::kDriveAndFriction).squares;
}

TEST(LoneMotor, IsFollowedThroughItsRest) {
  const FreeMotion motion = rest(4.0);
  EXPECT_LT(std::sqrt(squares_left(motion) / 246.0), 1e-3 * std::abs(motion.x[500] - motion.x[350]));
}

TEST(LoneMotor, ThatRestsAtSomethingThatBrakesItIsNotFollowed) {
  EXPECT_GT(squares_left(rest(12.0)), 100.0 * squares_left(rest(4.0)));
}

TEST(LoneMotor, ALawThatIsNotDrivenFollowsNothing) {
  EXPECT_TRUE(std::isinf(squares_left(rest(4.0), {0.0, 20.0, 0.0})));
}

void expect_told(std::uint64_t seed, Waveform waveform) {
  independent_plant::BlindCase c = independent_plant::random_drive(seed, waveform);
  c.options.tolerance = independent_plant::kFastTolerance;
  const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
  MotorTrace trace = run.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  const GapEstimate estimate = detect_gap({&trace, 1});
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << seed << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, c.drive.gap) << seed;
  EXPECT_GE(estimate.ci95.high, c.drive.gap) << seed;
}

TEST(LoneMotor, ArrivalsOfAFewCountsAtALoadAreToldFromThoseOfALoneMotorByTheRestAfterThem) {
  expect_told(4100062, Waveform::kSine);       // 97 counts, one passage at a time
  expect_told(4100220, Waveform::kSine);       // 104 counts, all passages together
  expect_told(3380009, Waveform::kTrapezoid);  // 36 counts
}

TestDrive one_inertia() {
  TestDrive drive;
  drive.m1 += drive.m2, drive.Fc1 = 0.03, drive.m2 = 0.0;
  return drive;
}

TEST(OneBody, AnInertiaWithDryFrictionIsExplainedToACount) {
  const TestDrive drive = one_inertia();
  const TestRecording recording = record(drive, sine(0.5814, 1.0), {.duration = 5.0, .bits = 16});
  const MotorTrace trace = recording.trace();
  const OneBodyFit fit = fit_one_body(trace, signals::read_facts(trace));
  EXPECT_LT(fit.left, recording.quantum);
  EXPECT_NEAR(fit.law.drive * drive.m1 / drive.Km, 1.0, 0.02);
  EXPECT_NEAR(fit.law.dry * drive.m1 / drive.Fc1, 1.0, 0.02);
}

/// The gap that is denied is larger than the one that is there, whatever the load: it leaves more.
TEST(OneBody, AGapLeavesMoreThanThatOfTheLightestLoad) {
  for (const std::uint64_t seed : {4100003u, 4100009u, 4100027u, 4100034u, 4100098u}) {
    independent_plant::BlindCase c = independent_plant::random_drive(seed);
    c.options.tolerance = independent_plant::kFastTolerance;
    const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
    MotorTrace trace = run.recording.motor_trace();
    trace.quantum = c.sensor.quantum;
    EXPECT_GT(fit_one_body(trace, signals::read_facts(trace)).hidden, c.drive.gap) << seed;
  }
}

/// Of a light load that slides without friction one body leaves little of the gap.
TEST(OneBody, NorIsALightLoadThatSlidesDenied) {
  TestDrive drive = one_inertia();
  drive.m1 /= 1.2, drive.m2 = 0.2 * drive.m1;
  drive.Fc1 = drive.Fc2 = 0.0, drive.d2 = 1e-3;
  const TestRecording recording = record(drive, sine(0.5814, 1.0), {.duration = 6.0, .bits = 18});
  const MotorTrace trace = recording.trace();
  const OneBodyFit fit = fit_one_body(trace, signals::read_facts(trace));
  EXPECT_LT(fit.left, 0.02 * drive.gap);
  EXPECT_GT(fit.hidden, drive.gap);
  EXPECT_LT(fit.hidden, 4.0 * drive.gap);
}

TEST(OneBody, WhatMayHoldTheLoadOnOneFlankLeavesEveryGapOpen) {
  TestRecording recording = record(one_inertia(), sine(0.5814, 1.0), {.duration = 5.0});
  const auto visible = [&] {
    const MotorTrace trace = recording.trace();
    return one_body_visible_gap(trace, signals::read_facts(trace));
  };
  EXPECT_LT(visible(), 0.002);
  for (double& u : recording.u) u -= 0.1;  // a torque that is not told
  EXPECT_TRUE(std::isinf(visible()));
}

TEST(OneBody, WithoutAnInputNothingIsExplained) {
  TestRecording recording = record(one_inertia(), sine(0.5814, 1.0), {.duration = 5.0});
  for (double& u : recording.u) u = 0.0;
  const MotorTrace trace = recording.trace();
  EXPECT_TRUE(std::isinf(fit_one_body(trace, signals::read_facts(trace)).left));
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
