#include <gtest/gtest.h>

#include <cmath>

#include "independent_plant/random_drive.h"
#include "signals/signal_facts.h"
#include "sliding_mode/one_body.h"
#include "sliding_mode/test_drive.h"
#include "sliding_mode/visible_gap.h"

namespace gapscope::internal::sliding_mode {
namespace {

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
