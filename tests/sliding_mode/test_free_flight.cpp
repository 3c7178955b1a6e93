#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/passage/flight.h"

namespace gapscope::internal::sliding_mode {
namespace {

using independent_plant::BlindDrive;
using independent_plant::BlindRun;
using independent_plant::GapPassage;

BlindRun simulate(const BlindDrive& drive, int bits = 20) {
  independent_plant::BlindExcitation sine;
  independent_plant::BlindOptions options;
  options.duration = 7.0;
  options.tolerance = independent_plant::kFastTolerance;
  return independent_plant::simulate_blind(drive, sine, independent_plant::BlindSensor::with_bits(bits),
                                           options);
}

BlindDrive coasting_drive() {
  BlindDrive drive;  // its load has so little friction that it is still on its way when the motor turns
  drive.load_coulomb = 0.004;
  drive.load_damping = 0.018;
  return drive;
}

const GapPassage& late_passage(const BlindRun& run) {
  for (const GapPassage& p : run.truth.passages)
    if (p.t1 > 4.0 && p.from_flank * p.to_flank < 0) return p;
  throw std::logic_error("no passage");
}

signals::LawStretch window_of(const MotorTrace& trace, const GapPassage& p) {
  const auto at = [&](double t) { return static_cast<std::size_t>(t / trace.dt); };
  signals::LawStretch w{at(p.t1 - 0.2), at(p.t2) + 5, 0.0, p.to_flank};
  std::size_t turn = w.first;
  for (std::size_t i = w.first; i <= at(p.t2); ++i)
    if (w.direction * trace.x1[i] <= w.direction * trace.x1[turn]) turn = i;
  w.turn = static_cast<double>(turn);
  return w;
}

class ReleaseOf : public testing::TestWithParam<bool> {};

TEST_P(ReleaseOf, IsFoundWhereContactWasLostWithTheSpeedOfTheLoadThere) {
  const BlindRun run = simulate(GetParam() ? coasting_drive() : BlindDrive{});
  const MotorTrace trace = run.recording.motor_trace();
  const GapPassage& p = late_passage(run);
  const double noise = trace.quantum / std::sqrt(12.0);
  const auto core = static_cast<std::size_t>(p.t2 / trace.dt) - 3;
  const FreeFlight flight = FlightLaw(trace, window_of(trace, p), noise).find_release(core);
  ASSERT_TRUE(flight.found);
  const double passage = p.t2 - p.t1, gap = p.gap;
  EXPECT_NEAR(flight.begin.time * trace.dt, p.t1, 0.06 * passage);
  // In motion an error of t1 moves x1(t1) with the load: it cancels in the gap.
  EXPECT_NEAR(flight.begin.motor.position - p.x1_t1,
              flight.begin.motor.speed * (flight.begin.time * trace.dt - p.t1), 0.01 * gap);
  const auto i = static_cast<std::size_t>(p.t1 / trace.dt);
  EXPECT_NEAR(flight.begin.motor.speed, run.truth.w2[i], 0.03 * std::abs(run.truth.w2[i]) + 0.01);
  EXPECT_LE(flight.earliest.time, flight.begin.time);
  EXPECT_GE(flight.latest.time, flight.begin.time);
}

INSTANTIATE_TEST_SUITE_P(Loads, ReleaseOf, testing::Values(false, true),
                         [](const auto& load) { return load.param ? "ThatCoasts" : "AtRest"; });

TEST(FlightLaw, FindsTheMotorsOwnCoefficientsWithoutBeingToldAny) {
  const BlindDrive drive;
  const BlindRun run = simulate(drive, 24);
  const MotorTrace trace = run.recording.motor_trace();
  const GapPassage& p = late_passage(run);
  const FlightLaw law(trace, window_of(trace, p), trace.quantum);
  FlightLaw::Fit fit;
  ASSERT_TRUE(law.fit_before(static_cast<std::size_t>(p.t2 / trace.dt) - 3, fit));
  const double b = fit.numbers(signals::LawColumns::kDrive), a = -fit.numbers(signals::LawColumns::kViscous);
  EXPECT_NEAR(b, drive.torque_constant / drive.motor_inertia, 0.03 * b);
  EXPECT_NEAR(a, drive.motor_damping / drive.motor_inertia, 0.03 * a);
}

TEST(FlightLaw, OneLawForTheWholeStrokeMeansThatNoContactWasLost) {
  BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  const BlindRun run = simulate(drive);
  const MotorTrace trace = run.recording.motor_trace();
  const signals::LawStretch window{10000, 11200, 10400.0, 1};
  EXPECT_FALSE(FlightLaw(trace, window, trace.quantum / std::sqrt(12.0)).find_release(11000).found);
}

TEST(FlightLaw, TheGapOfALoadThatCoastsIsReadNotItsUncorrectedS5) {
  const BlindDrive drive = coasting_drive();
  const BlindRun run = simulate(drive);
  const MotorTrace trace = run.recording.motor_trace();
  const GapEstimate estimate = detect_gap({&trace, 1});
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.reason.text();
  EXPECT_NEAR(estimate.gap, drive.gap, 0.1 * drive.gap);
  EXPECT_LE(estimate.ci95.low, drive.gap);
  EXPECT_GE(estimate.ci95.high, drive.gap);
  EXPECT_GT(std::abs(estimate.events.back().gap_uncorrected / drive.gap - 1.0), 0.03);
}

GapEstimate detect(independent_plant::BlindCase c) {
  c.options.tolerance = independent_plant::kFastTolerance;
  const BlindRun run = independent_plant::simulate_blind(c);
  MotorTrace trace = run.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  return detect_gap({&trace, 1});
}

TEST(FreeFlight, AFlightThatBeginsInTheReboundOfAnImpactIsNotUsed) {
  const independent_plant::BlindCase c =
      independent_plant::random_drive(320033, independent_plant::Waveform::kMultisine);
  const GapEstimate estimate = detect(c);
  EXPECT_TRUE(std::any_of(estimate.events.begin(), estimate.events.end(), [](const GapEvent& e) {
    return e.remark.starts_with("the impact before it threw motor and load apart");
  }));
  if (estimate.verdict == GapVerdict::kBacklash) {
    EXPECT_NEAR(estimate.gap, c.drive.gap, 0.08 * c.drive.gap) << estimate.brief_report();
  }
}

TEST(FreeFlight, AMotorThatCatchesUpWithItsLoadCrossedNoGap) {
  for (const std::uint64_t seed : {3300075, 3600027}) {  // read 195 % too large and 85 % too small
    const independent_plant::BlindCase c =
        independent_plant::random_drive(seed, independent_plant::Waveform::kMultisine);
    const GapEstimate estimate = detect(c);
    if (estimate.verdict == GapVerdict::kBacklash) {
      EXPECT_NEAR(estimate.gap, c.drive.gap, 0.08 * c.drive.gap) << estimate.brief_report();
    }
    if (seed == 3600027) continue;  // refused for its other passages
    EXPECT_GE(
        std::count_if(estimate.events.begin(), estimate.events.end(),
                      [](const GapEvent& e) { return e.remark == "the flank that was left is hit again"; }),
        4);
  }
}

TEST(FreeFlight, AMotorThatSlowsDownDidNotCrossAGapFromRest) {
  const independent_plant::BlindCase wide =
      independent_plant::random_drive(320204, independent_plant::Waveform::kMultisine);
  const GapEstimate estimate =
      detect(wide);  // read 28 % too small where the release is taken at a later kink
  if (estimate.verdict == GapVerdict::kBacklash) {
    EXPECT_NEAR(estimate.gap, wide.drive.gap, 0.08 * wide.drive.gap) << estimate.brief_report();
  }
  const independent_plant::BlindCase presliding =
      independent_plant::random_gap_free_drive(310699, 310699 % independent_plant::kGapFreeKinds);
  EXPECT_NE(detect(presliding).verdict, GapVerdict::kBacklash);
}

TEST(FreeFlight, TheLawOfTheFlightAndTheContactAreFittedTogether) {
  const independent_plant::BlindCase c =
      independent_plant::random_drive(340203);  // soft: 11 % too small with a law carried on alone
  const GapEstimate estimate = detect(c);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.reason.text();
  EXPECT_NEAR(estimate.gap, c.drive.gap, 0.03 * c.drive.gap);
}

TEST(FreeFlight, AnUnsymmetricalMotionMayShowTheGapOneWayOnly) {
  const independent_plant::BlindCase c =
      independent_plant::random_drive(3331005, independent_plant::Waveform::kMultisine);
  const GapEstimate estimate = detect(c);  // before its other passages the contact rings until it is lost
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.reason.text();
  EXPECT_NE(estimate.reason.text().find("all with falling x1"), std::string::npos) << estimate.reason.text();
  EXPECT_NEAR(estimate.gap, c.drive.gap, 0.03 * c.drive.gap);
}

TEST(FreeFlight, ALoadWhoseStateBeforeAndAfterItsReleaseDisagreesIsNotTrusted) {
  // Read 22 and 15 % too large when only the flight was asked.
  for (const std::uint64_t seed : {345157, 345206})
    EXPECT_EQ(detect(independent_plant::random_drive(seed, independent_plant::Waveform::kMultisine)).verdict,
              GapVerdict::kInconclusive)
        << seed;
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
