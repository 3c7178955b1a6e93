#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/shared_law.h"

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

/// ẍ = 3 u − 2 ẋ − 0.5 sign(ẋ), in small steps.
struct KnownMotion {
  std::vector<double> u, x1;

  KnownMotion() {
    double x = 0.1, v = 0.0;
    for (int i = 0; i < 2000; ++i) {
      u.push_back(std::sin(2.0 * kPi * 1e-3 * i));
      x1.push_back(x);
      for (int k = 0; k < 100; ++k) {
        v += 1e-5 * (3.0 * u.back() - 2.0 * v - 0.5 * (v > 0.0 ? 1.0 : -1.0));
        x += 1e-5 * v;
      }
    }
  }
};

std::size_t turn_after(const MotorTrace& trace, std::size_t i) {
  const bool rising = trace.x1[i + 1] > trace.x1[i];
  while ((trace.x1[i + 1] > trace.x1[i]) == rising) ++i;
  return i;
}

TEST(SharedLaw, FindsTheLawThatStretchesShareAndTheStateInEach) {
  const KnownMotion motion;
  const MotorTrace trace{"known", 0.0, 1e-3, motion.u, motion.x1};
  const std::size_t turn = turn_after(trace, 400), next = turn_after(trace, turn + 5);
  const std::vector<LawStretch> stretches{{turn - 200, static_cast<double>(turn) + 1.0, turn + 200, -1},
                                          {turn + 210, static_cast<double>(turn) + 210.0, next - 20, -1}};
  const SharedLaw law(trace, stretches);
  EXPECT_NEAR(law.drive(), 3.0, 0.01);
  EXPECT_NEAR(law.viscous(), 2.0, 0.05);
  EXPECT_NEAR(law.dry(), 0.5, 0.02);
  EXPECT_LT(law.rms(), 1e-5);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t i = stretches[k].last - 50;
    const SharedLaw::State s = law.state(k, static_cast<double>(i));
    EXPECT_NEAR(s.position, trace.x1[i], 1e-5);
    EXPECT_NEAR(s.speed, (trace.x1[i + 1] - trace.x1[i - 1]) / 2e-3, 2e-3);
  }
  const SharedLaw rest = law.without(1, 2);  // the first stretch alone
  EXPECT_NEAR(rest.drive(), 3.0, 0.05);
}

TEST(SharedLaw, FrictionThatWouldDriveIsNoneWhereItIsToBePassive) {
  std::vector<double> u, x1;
  for (int i = 0; i < 400; ++i) {
    const double t = 1e-3 * i;
    u.push_back(1.0);
    x1.push_back(1.5 * t * t + 0.4 * t * t * t);  // gains acceleration under a constant torque
  }
  const MotorTrace trace{"driven", 0.0, 1e-3, u, x1};
  const std::vector<LawStretch> stretches{{10, 10, 390, 1}};
  EXPECT_LT(SharedLaw(trace, stretches).viscous(), -0.1);
  const SharedLaw passive(trace, stretches, SharedLaw::Friction::kPassive);
  EXPECT_GE(passive.viscous(), 0.0);
  EXPECT_GE(passive.dry(), 0.0);
  EXPECT_GT(passive.rms(), 10.0 * SharedLaw(trace, stretches).rms());
}

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
  EXPECT_NE(s.read().verdict, GapVerdict::kBacklash);
}

TEST(Coasting, ASoftContactIsReadWhereItsIntervalIsNarrowEnough) {
  const CoastingSubject s(871060);  // the motor goes on for 7.3 % of the gap before its impacts show
  const GapEstimate estimate = s.read();
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
  const GapEstimate softer = CoastingSubject(871114).read();  // 12 %
  EXPECT_EQ(softer.verdict, GapVerdict::kInconclusive);
  EXPECT_THAT(softer.reason.text(), ::testing::HasSubstr("before the encoder shows the impact"));
}

TEST(Coasting, AMotorThatComesToRestWithinTheGapTellsNoGap) {
  const CoastingSubject s(3380020, independent_plant::Waveform::kTrapezoid);  // 11 % too small from its rest
  const GapEstimate estimate = s.read();
  EXPECT_NE(estimate.verdict, GapVerdict::kBacklash);
  EXPECT_EQ(std::ranges::count_if(estimate.events, &GapEvent::accepted), 0);
  EXPECT_NE(detect_gap({&s.trace, 1}, {.frozen = true}).verdict, GapVerdict::kBacklash);
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
  EXPECT_LT(estimate.std, 0.01 * s.c.drive.gap);  // 3 % where its roundings are taken for bounces
}

TEST(Coasting, AMotionThatSettlesInItsFirstPeriodIsPeriodic) {
  expect_within_interval(CoastingSubject(4100296), 0.03);  // no half period found about the centre of all
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
