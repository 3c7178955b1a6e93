// Quasi-static drives of the independent plant: slow ramps against a locked or very heavy load.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "drives/family.h"
#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/simulate.h"
#include "sliding_mode/verdict/lost_motion.h"

namespace gapscope {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr double kTorque = 0.2;  // amplitude [N m]

/// Locked output; 2β = 10 mrad by default, 1 mrad of elastic wind-up at the amplitude.
independent_plant::BlindDrive locked(double gap = 0.01) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kLocked;
  drive.gap = gap;
  drive.contact_stiffness = 200.0;
  return drive;
}

Recording ramps(const independent_plant::BlindDrive& drive, double torque = kTorque, int bits = 18,
                std::uint64_t seed = 1) {
  independent_plant::BlindExcitation triangle;
  triangle.waveform = independent_plant::Waveform::kTriangle;
  triangle.amplitude = torque / drive.torque_constant;
  triangle.frequency = 0.2;
  independent_plant::BlindOptions options;
  options.rate = 400.0;
  options.duration = 25.0;
  options.seed = seed;
  options.tolerance = independent_plant::kFastTolerance;
  return simulate_blind(drive, triangle, independent_plant::BlindSensor::with_bits(bits, 0.5), options)
      .recording;
}

GapEstimate detect(const std::vector<Recording>& recordings, bool declared_locked = false) {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return detect_gap(traces, {.locked = declared_locked});
}

void expect_play(const GapEstimate& estimate, double play) {
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_EQ(estimate.method, GapMethod::kLostMotion);
  EXPECT_EQ(estimate.quantity, GapQuantity::kPlayAtZeroTorque);
  EXPECT_NEAR(estimate.gap / play, 1.0, 0.02) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, play);
  EXPECT_GE(estimate.ci95.high, play);
  EXPECT_LT(estimate.smallest_visible_gap, play);
}

TEST(LostMotion, WithoutFrictionThePlayIsTheGap) {
  const GapEstimate estimate = detect({ramps(locked())}, true);
  expect_play(estimate, 0.01);
  ASSERT_EQ(estimate.warnings.size(), 1u);
  EXPECT_THAT(estimate.warnings[0].text(), HasSubstr("one torque level only"));
}

TEST(LostMotion, FrictionOfTheMotorAddsItsWindUpOnBothFlanks) {
  for (const double level : {0.02, 0.06}) {
    independent_plant::BlindDrive drive = locked();
    drive.effects.motor.friction.level_nm = level;
    expect_play(detect({ramps(drive)}, true), 0.01 + 2.0 * level / drive.contact_stiffness);
  }
}

/// A load that slides makes such a loop, too: nobody has said that this one does not move.
TEST(LostMotion, OfAnOutputThatIsNotDeclaredLockedOneLevelIsABound) {
  independent_plant::BlindDrive drive = locked();
  drive.load = independent_plant::BlindLoad::kFree;
  drive.load_inertia = 300.0 * drive.motor_inertia;
  drive.load_coulomb = 0.5;
  const GapEstimate estimate = detect({ramps(drive)});
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(estimate.reason.code(), "play_is_a_bound");
  EXPECT_GE(estimate.gap_at_most, 0.01);
  EXPECT_LT(estimate.gap_at_most, 0.012);
  expect_play(detect({ramps(drive)}, true), 0.01);
}

/// Friction of the load near the torque, and a travel of little more than the gap.
TEST(LostMotion, AFreeLoadThatHardlySlidesTellsNoGapThatIsTooLarge) {
  const independent_plant::ChainCase c =
      independent_plant::draw_family("low_travel", 6);  // a play at zero torque of 21 mrad, a gap of 10
  const independent_plant::ChainRun run = independent_plant::simulate_chain(c);
  const MotorTrace trace = run.recording.motor_trace();
  const GapEstimate estimate = detect_gap({&trace, 1});
  EXPECT_NE(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_GE(estimate.gap_at_most, independent_plant::total_gap(c.drive).high);
}

TEST(LostMotion, OnlyTheZeroOfTheInputCountsNotItsUnit) {
  Recording recording = ramps(locked());
  const GapEstimate plain = detect({recording}, true);
  for (double& u : recording.u) u *= 1000.0;
  EXPECT_DOUBLE_EQ(detect({recording}, true).gap, plain.gap);
}

TEST(LostMotion, HysteresisOfFrictionAndComplianceIsNoPlay) {
  independent_plant::BlindDrive coulomb = locked(0.0), presliding = locked(0.0), soft = locked(0.0);
  coulomb.effects.motor.friction.level_nm = 0.08;
  presliding.effects.motor.bristle = {.level_nm = 0.1, .length_rad = 5e-3};
  soft.contact_stiffness = 10.0;
  soft.effects.motor.friction.level_nm = 0.15;
  for (const independent_plant::BlindDrive& drive : {coulomb, presliding, soft}) {
    const GapEstimate estimate = detect({ramps(drive)});
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
    EXPECT_THAT(estimate.reason.code(), AnyOf("hysteresis_hides", "sticks_and_leaps"));
    EXPECT_NE(estimate.lost_motion.cause, LostMotionCause::kGap) << estimate.lost_motion.meaning;
    EXPECT_LT(estimate.lost_motion.gap_limit, 0.05);
  }
}

TEST(LostMotion, HysteresisOfFrictionIsMeasuredThoughItIsNoPlay) {
  independent_plant::BlindDrive coulomb = locked(0.0);
  coulomb.effects.motor.friction.level_nm = 0.08;  // 2·Fc/k = 0.8 mrad
  const LostMotion m = detect({ramps(coulomb)}).lost_motion;
  EXPECT_EQ(m.cause, LostMotionCause::kFriction) << m.meaning;
  EXPECT_NEAR(m.value, 0.8e-3, 0.03e-3);
  EXPECT_LE(m.ci95.low, 0.8e-3);
  EXPECT_GE(m.ci95.high, 0.8e-3);
  EXPECT_LT(m.ci95.high - m.ci95.low, 0.1e-3);
}

TEST(LostMotion, IsMostlyAGapWhereXRunsFreeAtOneTorque) {
  independent_plant::BlindDrive drive = locked();
  drive.effects.motor.friction.level_nm = 0.06;
  const LostMotion m = detect({ramps(drive)}).lost_motion;
  EXPECT_EQ(m.cause, LostMotionCause::kGap) << m.meaning;
  ASSERT_EQ(m.levels.size(), 1u);
  EXPECT_NEAR(m.levels[0].free_run, 0.01, 0.002);
  EXPECT_NEAR(0.172 / m.levels[0].flank / drive.contact_stiffness, 1.0, 0.4) << "a bin is four counts";
}

/// A fast sine of a locked drive, whose x1 rings and does not follow u.
Recording fast_locked() {
  independent_plant::BlindDrive drive = locked();
  drive.motor_damping *= 0.2;
  independent_plant::BlindExcitation sine;
  sine.amplitude = 0.2;
  sine.frequency = 4.0;
  return simulate_blind(drive, sine, independent_plant::BlindSensor::with_bits(12),
                        {.rate = 400.0, .duration = 3.0, .tolerance = independent_plant::kFastTolerance})
      .recording;
}

TEST(LostMotion, ALockedDriveIsNeverToldToLetItsLoadRest) {
  const Recording fast = fast_locked();
  const MotorTrace trace = fast.motor_trace();
  const GapEstimate estimate = detect_gap({&trace, 1}, {.locked = true});
  ASSERT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
  EXPECT_EQ(estimate.reason.code(), "locked_without_loop");
  EXPECT_THAT(estimate.reason.text(), HasSubstr("ramp the torque slowly"));
}

TEST(LostMotion, ALockedDriveWithAGivenBoundIsToldOfItsLoop) {
  const Recording slow = ramps(locked());
  const MotorTrace trace = slow.motor_trace();
  const GapEstimate estimate = detect_gap({&trace, 1}, {.locked = true, .bound = 1.0});
  ASSERT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
  EXPECT_EQ(estimate.reason.code(), "locked_with_bound");
  EXPECT_THAT(estimate.reason.text(), HasSubstr("detector: bound: auto"));
}

TEST(LostMotion, TheMethodThatIsAskedForIsTheOneThatAnswers) {
  const Recording slow = ramps(locked()), fast = fast_locked();
  const MotorTrace ramped = slow.motor_trace(), shaken = fast.motor_trace();
  const GapEstimate loop = detect_gap({&ramped, 1}, {.method = DetectorMethod::kLostMotion, .locked = true});
  EXPECT_EQ(loop.verdict, GapVerdict::kBacklash);
  EXPECT_EQ(loop.method, GapMethod::kLostMotion);
  const GapEstimate impact = detect_gap({&ramped, 1}, {.method = DetectorMethod::kImpact});
  EXPECT_EQ(impact.method, GapMethod::kImpact);
  EXPECT_DOUBLE_EQ(impact.lost_motion.value, loop.gap) << "measured beside any verdict";
  const GapEstimate none = detect_gap({&shaken, 1}, {.method = DetectorMethod::kLostMotion});
  EXPECT_EQ(none.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(none.reason.code(), "no_loop");
}

TEST(LostMotion, ADriveThatSticksAndLeapsIsNotReadAsPlay) {
  for (const double stiction : {0.5, 1.0}) {
    independent_plant::BlindDrive drive = locked(0.0);
    drive.contact_stiffness = 20.0;
    drive.effects.motor.friction = {
        .level_nm = 0.04, .stiction_ratio = stiction, .stribeck_speed_rad_s = 0.1};
    const GapEstimate estimate = detect({ramps(drive)});
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << stiction;
    EXPECT_EQ(estimate.reason.code(), "hysteresis_hides") << stiction;
  }
}

TEST(LostMotion, TorqueLevelsThatAgreeAreReadTogether) {
  independent_plant::BlindDrive drive = locked();
  drive.effects.motor.friction.level_nm = 0.02;
  const GapEstimate estimate = detect({ramps(drive, 0.1), ramps(drive, 0.3, 18, 2)});
  expect_play(estimate, 0.0102);
  EXPECT_THAT(estimate.reason.text(), HasSubstr(" ramps), 10"));  // both levels are listed
  EXPECT_TRUE(estimate.warnings.empty());
}

TEST(LostMotion, TorqueLevelsThatDisagreeAreToldAndNotAveraged) {
  independent_plant::BlindDrive drive =
      locked(0.0);  // below the friction nothing moves: the small ramps only wind it up
  drive.contact_stiffness = 20.0;
  drive.effects.motor.friction.level_nm = 0.08;
  const GapEstimate estimate = detect({ramps(drive, 0.1), ramps(drive, 0.4)});
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
  EXPECT_TRUE(std::isnan(estimate.gap));
  EXPECT_THAT(estimate.reason.text(), HasSubstr("depends on the torque level"));
}

TEST(LostMotion, AFreeLoadIsNotQuasiStatic) {
  independent_plant::BlindDrive free;
  independent_plant::BlindExcitation sine;
  sine.frequency = 0.2;
  independent_plant::BlindOptions options;
  options.rate = 400.0;
  options.duration = 25.0;
  options.tolerance = independent_plant::kFastTolerance;
  const Recording recording =
      simulate_blind(free, sine, independent_plant::BlindSensor::with_bits(18), options).recording;
  const MotorTrace trace = recording.motor_trace();
  const internal::signals::SignalFacts facts = internal::signals::read_facts(trace);
  const auto search = internal::sliding_mode::read_lost_motion({&trace, 1}, {&facts, 1});
  EXPECT_FALSE(search.found);
  EXPECT_EQ(search.why_not.code(), "does_not_follow");
}

TEST(LostMotion, ARecordingWithoutHalfCyclesHasNoLoop) {
  const std::vector<double> u(500, 0.1), x1(500, 0.2);
  const MotorTrace trace{"constant.csv", 0.0, 1e-3, u, x1, 0.0};
  const internal::signals::SignalFacts facts = internal::signals::read_facts(trace);
  EXPECT_FALSE(internal::sliding_mode::read_lost_motion({&trace, 1}, {&facts, 1}).found);
  EXPECT_FALSE(internal::sliding_mode::read_lost_motion({}, {}).found);
}

TEST(LostMotion, DeniesNothingWhereTheMotorHardlyMoves) {
  independent_plant::BlindDrive stiff = locked(0.0);
  stiff.contact_stiffness = 1e5;  // 2 µrad of wind-up, a tenth of a count
  EXPECT_EQ(detect({ramps(stiff)}).verdict, GapVerdict::kInconclusive);
  Recording counts = ramps(stiff);
  for (std::size_t i = 0; i < counts.size(); ++i)  // one count to and fro with the torque
    counts.x1[i] = 2.4e-5 * (counts.u[i] > 0.2 ? 1.0 : counts.u[i] < -0.2 ? -1.0 : 0.0);
  counts.quantum = 2.4e-5;
  const GapEstimate estimate = detect({counts});
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
}

/// Gapless, with hysteresis of friction.
Recording hysteresis() {
  independent_plant::BlindDrive coulomb = locked(0.0);
  coulomb.effects.motor.friction.level_nm = 0.08;
  return ramps(coulomb);
}

TEST(LostMotion, DeniesNothingWhereTheMotorMovesOnOneRampOnly) {
  const Recording whole = hysteresis();
  ASSERT_EQ(detect({whole}).reason.code(), "hysteresis_hides");
  Recording late = whole, jump = whole;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i < whole.size() * 17 / 20) late.x1[i] = whole.x1[whole.size() * 17 / 20];
    jump.x1[i] = i < whole.size() / 2 ? 0.01 : 0.0;  // as u falls
  }
  for (const Recording& once : {late, jump}) {
    const GapEstimate estimate = detect({once});
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
    EXPECT_THAT(estimate.reason.text(), HasSubstr("on a ramp the motor moves by 0 rad"));
  }
}

TEST(LostMotion, AnInputThatIsLateTurnsTheLoopRoundAndDeniesNothing) {
  const Recording whole = ramps(locked(0.02));
  bool told = false;
  for (std::size_t samples = 0; samples <= 120; samples += 10) {
    Recording late = whole;
    for (std::size_t i = 0; i < late.size(); ++i) late.u[i] = whole.u[i - std::min(i, samples)];
    const GapEstimate estimate = detect({late});
    EXPECT_NE(estimate.verdict, GapVerdict::kNone) << samples << ": " << estimate.brief_report();
    told = told || estimate.reason.text().find("runs backwards") != std::string::npos;
  }
  EXPECT_TRUE(told);
}

TEST(LostMotion, CountsThatFollowOneAnotherAreNoFreeRun) {
  Recording counts = hysteresis();
  counts.quantum = 1e-4;
  for (std::size_t i = 0; i < counts.size(); ++i)  // ten counts of a soft drive
    counts.x1[i] = counts.quantum * std::round(5.2 * counts.u[i] / 1.163);
  EXPECT_EQ(detect({counts}).reason.code(), "hysteresis_hides") << detect({counts}).brief_report();
}

TEST(LostMotion, AFreeRunWithoutAPlayIsNotDenied) {
  Recording sign = hysteresis(), half = sign, saturated = sign;
  for (std::size_t i = 0; i < sign.size(); ++i) {
    sign.x1[i] = sign.u[i] > 0.0 ? 0.1 : 0.0;
    half.x1[i] = 0.1 * std::max(sign.u[i], 0.0);
    saturated.x1[i] = 0.05 * std::clamp(sign.u[i], -0.1, 0.1);
  }
  for (const Recording& free : {sign, half, saturated}) {
    const GapEstimate estimate = detect({free});
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
    EXPECT_THAT(estimate.reason.code(), AnyOf("free_run_without_play", "sticks_and_leaps"));
  }
}

}  // namespace
}  // namespace gapscope
