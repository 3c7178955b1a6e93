#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "drives/closed_loop.h"

namespace gapscope::independent_plant {
namespace {

BlindDrive one_body() {
  BlindDrive drive;
  drive.load = BlindLoad::kNone;
  drive.motor_inertia = 2e-3;
  drive.motor_damping = 5e-3;
  return drive;
}

ControllerSettings loop_of(const BlindDrive& drive, double bandwidth_hz, double rate = 1000.0) {
  return tuned_controller(drive.motor_inertia, drive.torque_constant, bandwidth_hz, rate);
}

const BlindSensor kFine = BlindSensor::with_bits(20);
const BlindOptions kShort{.duration = 6.0, .seed = 3, .tolerance = kFastTolerance};

double following_error(const LoopRun& loop) {
  double square = 0.0;
  for (std::size_t k = 0; k < loop.target.size(); ++k)
    square += std::pow(loop.run.truth.x1[k] - loop.target[k].x, 2);
  return std::sqrt(square / static_cast<double>(loop.target.size()));
}

TEST(Controller, IsProportionalPlusIntegralOfTheSpeedThatIsMissing) {
  Controller controller({.rate = 100.0, .position_gain = 3.0, .speed_gain = 0.5, .integral_s = 0.2});
  EXPECT_DOUBLE_EQ(controller.step(0.0, 0.0, {2.0, 1.0}), 0.5 * 7.0);
  for (int k = 1; k <= 10; ++k) {  // x does not move: e = 7 for ever
    const double t = 0.01 * k;
    EXPECT_NEAR(controller.step(t, 0.0, {2.0, 1.0}), 0.5 * (7.0 + 7.0 * t / 0.2), 1e-12);
  }
}

TEST(Controller, ItsIntegralStandsStillInSaturation) {
  Controller bound({.speed_gain = 1.0, .integral_s = 0.01, .limit = 2.0});
  Controller free({.speed_gain = 1.0, .integral_s = 0.01});
  for (int k = 0; k < 1000; ++k) {
    EXPECT_EQ(bound.step(0.001 * k, 0.0, {0.0, 3.0}), 2.0);
    free.step(0.001 * k, 0.0, {0.0, 3.0});
  }
  EXPECT_LT(bound.step(1.0, 0.0, {0.0, -0.5}), 0.0);  // back at once
  EXPECT_GT(free.step(1.0, 0.0, {0.0, -0.5}), 100.0);
}

TEST(ClosedLoop, FollowsEveryReferenceAndBetterTheStifferItIs) {
  BlindDrive drive = one_body();
  drive.effects.motor.friction.level_nm = 0.02;
  for (const Course course : {Course::kConstantSpeed, Course::kSCurve, Course::kTriangle, Course::kTrapezoid,
                              Course::kSines, Course::kPickAndPlace}) {
    const ReferenceMotion motion{.course = course, .travel = 4.0, .speed = 6.0};
    const double stiff =
        following_error(simulate_closed_loop(drive, motion, loop_of(drive, 20.0), kFine, {}, kShort));
    const double soft =
        following_error(simulate_closed_loop(drive, motion, loop_of(drive, 4.0), kFine, {}, kShort));
    EXPECT_LT(stiff, 0.03 * motion.travel) << static_cast<int>(course);
    EXPECT_LT(stiff, 0.7 * soft) << static_cast<int>(course);
  }
}

TEST(ClosedLoop, AProportionalSpeedLoopStaysBehindByFrictionOverItsGain) {
  const BlindDrive drive = one_body();
  ControllerSettings loop = loop_of(drive, 10.0);
  loop.position_gain = 0.0, loop.integral_s = kInfinity;
  const ReferenceMotion motion{.course = Course::kConstantSpeed, .speed = 8.0};
  const LoopRun run = simulate_closed_loop(drive, motion, loop, {}, {.lead_s = 2.0}, kShort);
  const double gain = drive.torque_constant * loop.speed_gain;
  const double speed = 8.0 * gain / (gain + drive.motor_damping);
  for (const double w : run.run.truth.w1) ASSERT_NEAR(w, speed, 1e-4);
}

TEST(ClosedLoop, WhatIsRecordedReachedTheMotor) {
  BlindDrive drive = one_body();
  drive.effects.motor.cogging = {0.01, 12.0, 0.4, 0.2};
  const BlindSensor sensor = BlindSensor::with_bits(14, 0.5);
  for (const double rate : {1024.0, 1000.0}) {  // times with and without rounding
    ControllerSettings loop = loop_of(drive, 15.0, rate);
    loop.dead_time_s = 2.0 / rate;
    BlindOptions options = kShort;
    options.rate = rate;
    const LoopRun run = simulate_closed_loop(drive, {.course = Course::kSines}, loop, sensor, {}, options);
    const BlindRun again = simulate_blind_command(drive, run.run.recording.u, sensor, options);
    if (rate == 1024.0) {
      EXPECT_EQ(again.recording.x1, run.run.recording.x1);
      EXPECT_EQ(again.truth.w1, run.run.truth.w1);
    }
    for (std::size_t k = 0; k < again.truth.x1.size(); ++k)
      ASSERT_NEAR(again.truth.x1[k], run.run.truth.x1[k], 1e-7);  // a row late makes it 1e-3
  }
}

TEST(ClosedLoop, SaturatesAtItsLimit) {
  const BlindDrive drive = one_body();
  ControllerSettings loop = loop_of(drive, 20.0);
  const ReferenceMotion motion{.course = Course::kTriangle, .travel = 4.0, .speed = 6.0};
  const auto largest = [&] {
    const LoopRun run = simulate_closed_loop(drive, motion, loop, kFine, {}, kShort);
    double most = 0.0;
    for (const double u : run.run.recording.u) most = std::max(most, std::abs(u));
    return most;
  };
  EXPECT_GT(largest(), 2.0);
  loop.limit = 0.8;
  EXPECT_EQ(largest(), 0.8);
}

TEST(ClosedLoop, ADeadTimeOfItsOwnMakesAStiffLoopSwing) {
  const BlindDrive drive = one_body();
  ControllerSettings loop = loop_of(drive, 30.0);
  loop.limit = 3.0;
  const double prompt = following_error(simulate_closed_loop(drive, {}, loop, kFine, {}, kShort));
  loop.dead_time_s = 12e-3;
  const double late = following_error(simulate_closed_loop(drive, {}, loop, kFine, {}, kShort));
  EXPECT_GT(late, 5.0 * prompt);
}

TEST(ClosedLoop, StartsInMotionAfterItsLead) {
  const BlindDrive drive = one_body();
  const ReferenceMotion motion{.course = Course::kConstantSpeed, .speed = 8.0};
  const LoopRun run =
      simulate_closed_loop(drive, motion, loop_of(drive, 10.0, 200.0), kFine, {.lead_s = 1.5}, kShort);
  EXPECT_DOUBLE_EQ(run.stamps.front(), 1.5);
  EXPECT_DOUBLE_EQ(run.run.recording.start, 1.5);
  EXPECT_EQ(run.run.recording.size(), 1200u);
  EXPECT_NEAR(run.run.truth.w1.front(), 8.0, 0.5);
  EXPECT_NEAR(run.run.truth.x1.front(), 12.0, 0.5);
}

TEST(ClosedLoop, RowsOfItsOwnRateReadTheCommandThatIsInForce) {
  const BlindDrive drive = one_body();
  const ReferenceMotion motion{.course = Course::kSines};
  const LoopRun fast = simulate_closed_loop(drive, motion, loop_of(drive, 10.0), kFine, {}, kShort);
  const LoopRun slow =
      simulate_closed_loop(drive, motion, loop_of(drive, 10.0), kFine, {.rate = 250.0}, kShort);
  ASSERT_EQ(slow.run.recording.size(), 1500u);
  for (std::size_t k = 0; k < slow.stamps.size(); ++k) {
    ASSERT_EQ(slow.run.recording.u[k], fast.run.recording.u[4 * k]);
    ASSERT_EQ(slow.run.recording.x1[k], fast.run.recording.x1[4 * k]);
  }
}

TEST(ClosedLoop, StampsAreEvenUnlessTheyJitterOrGetLost) {
  const BlindDrive drive = one_body();
  ControllerSettings loop = loop_of(drive, 8.0, 200.0);
  const LoopRun even = simulate_closed_loop(drive, {}, loop, kFine, {}, kShort);
  for (std::size_t k = 0; k < even.stamps.size(); ++k)
    ASSERT_DOUBLE_EQ(even.stamps[k], static_cast<double>(k) / 200.0);
  EXPECT_EQ(even.run.recording.dt, 1.0 / 200.0);

  const LoopRun lossy = simulate_closed_loop(drive, {}, loop, kFine, {.lost_share = 0.1}, kShort);
  const double lost =
      1.0 - static_cast<double>(lossy.stamps.size()) / static_cast<double>(even.stamps.size());
  EXPECT_NEAR(lost, 0.1, 0.05);
  EXPECT_TRUE(
      std::includes(even.stamps.begin(), even.stamps.end(), lossy.stamps.begin(), lossy.stamps.end()));
  EXPECT_EQ(lossy.run.recording.size(), lossy.stamps.size());
  EXPECT_EQ(lossy.run.truth.w1.size(), lossy.stamps.size());

  loop.jitter_s = 2e-3;
  const LoopRun late = simulate_closed_loop(drive, {}, loop, kFine, {}, kShort);
  double latest = 0.0;
  for (std::size_t k = 0; k < late.stamps.size(); ++k) {
    const double delay = late.stamps[k] - even.stamps[k];
    ASSERT_GE(delay, -1e-12);
    latest = std::max(latest, delay);
  }
  EXPECT_NEAR(latest, 2e-3, 1e-4);
}

TEST(ClosedLoop, AMeasuredCurrentHasWentThroughTheDrivesOwnEffects) {
  BlindDrive drive = one_body();
  drive.effects.command.dead_zone = 0.05;
  const ReferenceMotion motion{.course = Course::kSines};
  const ControllerSettings loop = loop_of(drive, 10.0);
  LoopRecorder recorder;
  const std::vector<double> sent =
      simulate_closed_loop(drive, motion, loop, kFine, recorder, kShort).run.recording.u;
  recorder.input = RecordedInput::kCurrent;
  const std::vector<double> current =
      simulate_closed_loop(drive, motion, loop, kFine, recorder, kShort).run.recording.u;
  ASSERT_EQ(sent.size(), current.size());
  for (std::size_t k = 0; k < sent.size(); ++k)
    ASSERT_NEAR(current[k], std::copysign(std::max(0.0, std::abs(sent[k]) - 0.05), sent[k]), 1e-15);

  recorder.input_noise = 0.02;
  const std::vector<double> noisy =
      simulate_closed_loop(drive, motion, loop, kFine, recorder, kShort).run.recording.u;
  std::vector<double> noise;
  for (std::size_t k = 0; k < noisy.size(); ++k) noise.push_back(noisy[k] - current[k]);
  EXPECT_NEAR(rms(noise), 0.02, 0.02 * 3.0 / std::sqrt(2.0 * static_cast<double>(noise.size())));
}

TEST(ClosedLoop, IsRepeatedExactlyByItsSeed) {
  BlindDrive drive = one_body();
  ControllerSettings loop = loop_of(drive, 10.0);
  loop.jitter_s = 2e-4;
  const LoopRecorder recorder{.input = RecordedInput::kCurrent, .input_noise = 0.01, .lost_share = 0.02};
  const BlindSensor sensor = BlindSensor::with_bits(12, 0.5);
  const ReferenceMotion motion{.course = Course::kPickAndPlace};
  BlindOptions options = kShort;
  const LoopRun one = simulate_closed_loop(drive, motion, loop, sensor, recorder, options);
  const LoopRun again = simulate_closed_loop(drive, motion, loop, sensor, recorder, options);
  EXPECT_EQ(one.stamps, again.stamps);
  EXPECT_EQ(one.run.recording.u, again.run.recording.u);
  EXPECT_EQ(one.run.recording.x1, again.run.recording.x1);
  options.seed = 4;
  EXPECT_NE(one.stamps, simulate_closed_loop(drive, motion, loop, sensor, recorder, options).stamps);
}

/// J and d of the balance of momentum from row to row, Km·u·dt = J Δw + d Δx + c dt + lines, by least squares
/// on the true motion: no encoder stands between.
Eigen::Vector2d balance(const BlindDrive& drive, const LoopRun& loop, const std::vector<double>& periods) {
  const BlindTruth& truth = loop.run.truth;
  const auto n = static_cast<Eigen::Index>(truth.x1.size()) - 1;
  const double dt = loop.run.recording.dt;
  Eigen::MatrixXd g(n, 3 + 2 * static_cast<Eigen::Index>(periods.size()));
  Eigen::VectorXd pushed(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    pushed[i] = drive.torque_constant * loop.run.recording.u[k] * dt;
    g.row(i).head(3) << truth.w1[k + 1] - truth.w1[k], truth.x1[k + 1] - truth.x1[k], dt;
    for (std::size_t p = 0; p < periods.size(); ++p) {
      const double angle = periods[p] * 0.5 * (truth.x1[k] + truth.x1[k + 1]);
      g.row(i).segment(3 + 2 * static_cast<Eigen::Index>(p), 2) << std::sin(angle) * dt, std::cos(angle) * dt;
    }
  }
  return g.colPivHouseholderQr().solve(pushed).head<2>();
}

// At constant speed the only acceleration is what the loop answers to the torque that the model lacks: least
// squares finds the controller's inverse in place of the motor.
TEST(ClosedLoop, AtConstantSpeedTwoTorqueLinesMakeTheInertiaSeveralTimesWrong) {
  BlindDrive drive = one_body();
  drive.effects.motor.friction.level_nm = 0.03;
  drive.effects.motor.cogging = {0.02, 40.0, 0.3, 0.0};
  drive.effects.motor.second_cogging = {0.012, 10.0, 1.1, 0.0};
  ControllerSettings loop = loop_of(drive, 4.0);
  loop.position_gain = 0.0;
  const ReferenceMotion motion{.course = Course::kConstantSpeed, .speed = 5.0};
  const LoopRun run =
      simulate_closed_loop(drive, motion, loop, BlindSensor::with_bits(16), {.lead_s = 2.0}, kShort);
  const Eigen::Vector2d nominal = balance(drive, run, {}), with_lines = balance(drive, run, {40.0, 10.0});
  EXPECT_LT(nominal[0], drive.motor_inertia / 3.0);
  EXPECT_LT(nominal[1], 0.0);
  EXPECT_NEAR(with_lines[0], drive.motor_inertia, 0.02 * drive.motor_inertia);
  EXPECT_NEAR(with_lines[1], drive.motor_damping, 0.1 * drive.motor_damping);
}

}  // namespace
}  // namespace gapscope::independent_plant
