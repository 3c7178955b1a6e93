// A motor with dry friction that has left the load before it turns round.
#include <gtest/gtest.h>

#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/detector.h"
#include "sliding_mode/passage/turn.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

constexpr double kStep = 1e-3;                    // between samples [s]
constexpr double kArrival = 38.0, kLeave = 21.0;  // acceleration before and after the turn [rad/s²]

/// x1 = ½ a t² about `turn`, a different one on either side, as an encoder of that quantum reads it.
MotorTrace kinked_parabola(double turn, double quantum, std::vector<double>& x1) {
  for (int i = 0; i < 400; ++i) {
    const double t = kStep * (i - turn);
    x1.push_back(quantum * std::round(0.5 * (t < 0.0 ? kArrival : kLeave) * t * t / quantum));
  }
  return {"turn", 0.0, kStep, x1, x1, quantum};
}

/// Standard deviation of the instant [samples], by the roundings alone: the speed at the middle of n samples
/// over ±h, fitted beside t|t| and t³, has √300·σ/(h·√n) (the first entry of the inverse of their Gram matrix
/// 1/(i + j + 1), i, j = 1 … 3, is 300), and turns by the mean acceleration.
double rounding_of_turn(double quantum, double way) {
  const double stretch = std::sqrt(2.0 * way / kArrival) + std::sqrt(2.0 * way / kLeave);
  const double speed = std::sqrt(300.0 / (stretch / kStep)) * quantum / std::sqrt(12.0) / (0.5 * stretch);
  return speed / (0.5 * (kArrival + kLeave)) / kStep;
}

TEST(TurnTime, IsToldToAFractionOfASampleThoughTheAccelerationSteps) {
  constexpr double kQuantum = 1e-4, kWay = 5e-3;
  const double late = std::sqrt(kQuantum / kLeave) / kStep;  // half a count from the turn [samples]
  for (const double turn : {200.0, 200.3, 200.8}) {
    std::vector<double> x1;
    const MotorTrace trace = kinked_parabola(turn, kQuantum, x1);
    std::size_t first = 399, last = 0;
    for (std::size_t i = 0; i < x1.size(); ++i)
      if (!(x1[i] > 0.0)) first = std::min(first, i), last = i;
    EXPECT_NEAR(internal::sliding_mode::turn_time(trace, first, last, kWay), turn,
                3.0 * rounding_of_turn(kQuantum, kWay));
    EXPECT_GT(static_cast<double>(last) - turn, late - 1.0) << "the last sample at the extremum is late";
  }
}

/// The load coasts on while the motor turns, whose friction steps: that step was taken for the loss of
/// contact.
TEST(TurnTime, TheStepOfTheMotorsFrictionIsNoLossOfContact) {
  struct {
    double gap, friction;
    int bits;
  } constexpr kRigs[] = {{0.06, 0.01, 16}, {0.02, 0.02, 18}, {0.06, 0.02, 18}};
  for (const auto& rig : kRigs) {
    TestDrive drive{.m1 = 1.2e-3, .m2 = 1.5e-3, .Km = 1.0, .d1 = 0.012, .d2 = 0.01};
    drive.Fc2 = 0.03, drive.k = 900.0, drive.c = 0.3, drive.gap = rig.gap, drive.Fc1 = rig.friction;
    TestEncoder encoder;
    encoder.rate = 1000.0, encoder.duration = 8.0, encoder.bits = rig.bits, encoder.step = 1e-5;
    const TestRecording recording = record(drive, sine(0.15, 1.0), encoder);
    const MotorTrace trace = recording.trace();
    const GapEstimate g = detect_gap({&trace, 1});
    ASSERT_EQ(g.verdict, GapVerdict::kBacklash) << rig.gap << " " << g.reason.text();
    EXPECT_LE(g.ci95.low, rig.gap);
    EXPECT_GE(g.ci95.high, rig.gap);
  }
}

/// Load and motor stand at the reversal, each held by its own friction, until the torque overcomes the
/// motor's: every passage was refused as one that meets the flank again which it had left.
TEST(TurnTime, AMotorThatItsOwnFrictionHoldsAtARestingLoadCrossesTheWholeGap) {
  struct {
    double stiffness, friction_of_load;
  } constexpr kRigs[] = {{2400.0, 0.02}, {10000.0, 0.05}};
  for (const auto& rig : kRigs) {
    TestDrive drive{.m1 = 8.78e-4, .m2 = 5.7e-4, .Km = 0.172, .d1 = 0.03, .d2 = 0.03};
    drive.Fc1 = 0.002, drive.Fc2 = rig.friction_of_load, drive.k = rig.stiffness, drive.gap = 0.0118;
    TestEncoder encoder;
    encoder.rate = 2500.0, encoder.duration = 10.0, encoder.bits = 18;
    const auto triangle = [](double t) {
      return 0.75 * (2.0 / kPi) * std::asin(std::sin(2.0 * kPi * 0.8 * t));
    };
    const TestRecording recording = record(drive, triangle, encoder);
    const MotorTrace trace = recording.trace();
    const GapEstimate g = detect_gap({&trace, 1});
    ASSERT_EQ(g.verdict, GapVerdict::kBacklash) << rig.stiffness << " " << g.reason.text();
    EXPECT_LE(g.ci95.low, drive.gap);
    EXPECT_GE(g.ci95.high, drive.gap);
  }
}

/// The law of a moving motor leads such a one to a begin some time after it has broken loose: it read 12.81
/// mrad.
TEST(TurnTime, AMotorThatItsOwnFrictionHoldsLeavesFromWhereItStood) {
  TestDrive drive{.m1 = 8.78e-4, .m2 = 7e-4, .Km = 0.172, .d1 = 0.02, .d2 = 0.03};
  drive.Fc1 = 0.005, drive.Fc2 = 0.035, drive.k = 2400.0, drive.gap = 0.0134;
  TestEncoder encoder;
  encoder.rate = 2500.0, encoder.duration = 10.0, encoder.bits = 18;
  const auto triangle = [](double t) { return 0.6 * (2.0 / kPi) * std::asin(std::sin(2.0 * kPi * t)); };
  const TestRecording recording = record(drive, triangle, encoder);
  const MotorTrace trace = recording.trace();
  const GapEstimate g = detect_gap({&trace, 1});
  ASSERT_EQ(g.verdict, GapVerdict::kBacklash) << g.reason.text();
  EXPECT_NEAR(g.gap, drive.gap, 0.01 * drive.gap);
  EXPECT_LT(g.ci95.high - g.ci95.low, 0.1 * drive.gap);
}

/// A heavy load coasts on, and the motor stands still in the gap for a tenth of a second: the torque pushes
/// it back towards the load, but by less than its own friction, which shows no load there.
TEST(TurnTime, AMotorThatItsOwnFrictionHoldsInTheGapIsNotAtItsLoad) {
  TestDrive drive{.m1 = 8.78e-4, .m2 = 5.2e-3, .Km = 1.0, .d1 = 0.0364, .d2 = 0.0083};
  drive.Fc1 = 0.0203, drive.Fc2 = 0.0183, drive.k = 82.0, drive.c = 0.05, drive.gap = 0.01077;
  TestEncoder encoder;
  encoder.rate = 1000.0, encoder.duration = 15.0, encoder.noise = 0.5, encoder.step = 1e-5;
  const TestRecording recording = record(drive, sine(0.0744, 0.735), encoder);
  const MotorTrace trace = recording.trace();
  const GapEstimate g = detect_gap({&trace, 1});
  EXPECT_EQ(g.verdict, GapVerdict::kInconclusive) << "5.9 mrad without the rule";
  EXPECT_EQ(g.reason.code(), "few_passages");
}

}  // namespace
}  // namespace gapscope
