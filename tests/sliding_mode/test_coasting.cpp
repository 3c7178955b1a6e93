#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/as_stream.h"

namespace gapscope::internal::sliding_mode {
namespace {

using independent_plant::BlindCase;

struct CoastingSubject {
  BlindCase c;
  independent_plant::BlindRun run;
  MotorTrace trace;

  explicit CoastingSubject(std::uint64_t seed,
                           independent_plant::Waveform waveform = independent_plant::Waveform::kSine,
                           independent_plant::DriveLaws laws = independent_plant::DriveLaws::kStated)
      : c(independent_plant::random_drive(seed, waveform, laws)) {
    c.options.tolerance = independent_plant::kFastTolerance;
    run = independent_plant::simulate_blind(c);
    trace = run.recording.motor_trace();
    trace.quantum = c.sensor.quantum;
  }
  GapEstimate read() const { return detect_gap({&trace, 1}); }
};

TEST(Coasting, ALoadThatMovesIsReadWithTheFrictionThatItsEngagedFlankShows) {
  const CoastingSubject s(
      830004);  // travels 0.35 of the gap; 6 % too small by the motor's deceleration at t1
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.01 * s.c.drive.gap);
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
}

TEST(Coasting, ImpactsWithinAHalfPeriodOfTheMotionAreNoEchoesWhereTheTorqueTurnsMoreOften) {
  const CoastingSubject s(3331015, independent_plant::Waveform::kMultisine);
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.02 * s.c.drive.gap);
}

TEST(Coasting, ALoadThatHardlyMovesIsReadWithinWhatItMayHaveMoved) {
  const CoastingSubject s(877043);  // 0.001 of the gap; at some of the possible t1 it rests
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.01 * s.c.drive.gap);
}

TEST(Coasting, AContactThatRingsUntilItIsLostTellsNoTravelOfTheLoad) {
  const CoastingSubject s(810371);  // 24 % too large by the motor's speed at t1
  const GapEstimate estimate = s.read();
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(estimate.reason.code(), "few_passages");
}

TEST(Coasting, ASoftContactIsReadWithTheTrustThatItsIntervalEarns) {
  const CoastingSubject s(871060);  // the motor goes on for 7.3 % of the gap before its impacts show
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
  const GapEstimate softer = CoastingSubject(871114).read();  // 12 %
  EXPECT_NE(softer.trust, GapTrust::kGood);
}

TEST(Coasting, AMotorThatComesToRestWithinTheGapTellsNoGap) {
  const CoastingSubject s(3380020, independent_plant::Waveform::kTrapezoid);  // 11 % too small from its rest
  const GapEstimate estimate = s.read();
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(estimate.reason.code(), "few_passages");
  EXPECT_EQ(std::ranges::count_if(estimate.events, &GapEvent::accepted), 0);
  EXPECT_NE(as_stream(s.trace).estimate.verdict, GapVerdict::kBacklash);
}

TEST(Coasting, AMotorThatRestsAtItsLoadIsStillReadWhereTheTorqueRestsToo) {
  const CoastingSubject s(3380044, independent_plant::Waveform::kTrapezoid);
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.02 * s.c.drive.gap);
}

void expect_within_interval(const CoastingSubject& s, double error) {
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, error * s.c.drive.gap);
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
}

TEST(Coasting, ALoadThatOvertakesAMotorWhichNeverTurnsRoundHasCrossedTheGap) {
  expect_within_interval(CoastingSubject(4100031), 0.02);  // the load travels 2.5 gaps, the motor 1.5 with it
  expect_within_interval(CoastingSubject(4100039), 0.02);  // 10.3 and 9.3
}

TEST(Coasting, ALoadThatMayBeSlowedByEitherFrictionIsReadBetweenBoth) {
  expect_within_interval(CoastingSubject(4100231), 0.05);  // its laws alone tell 24.0 to 27.7 mrad of 25.9
}

TEST(Coasting, WhatIsLeftWithinTheNoiseTellsNoBounces) {
  const CoastingSubject s(4400237);  // a load at rest
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.02 * s.c.drive.gap);
  EXPECT_LT(estimate.std, 0.02 * s.c.drive.gap);  // 3 % where its roundings are taken for bounces
}

TEST(Coasting, AMotionThatSettlesInItsFirstPeriodIsPeriodic) {
  const CoastingSubject s(4100296);  // no half period is found about the centre of all
  EXPECT_EQ(signals::read_facts(s.trace).defect.code(), "");
  EXPECT_GE(signals::read_facts(s.trace).half_periods, 12u);
}

TEST(Coasting, AnImpactBeyondTheHighestBoundIsNoEchoOfTheMotorThatSpeedsUpBeforeIt) {
  const CoastingSubject s(4300016, independent_plant::Waveform::kSine, independent_plant::DriveLaws::kWide);
  const GapEstimate estimate = s.read();  // denied, with "above 2.5 mrad", where tops end with the bank
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
