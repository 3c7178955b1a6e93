#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/lone_motor.h"

namespace gapscope::internal::sliding_mode {
namespace {

using independent_plant::Waveform;

/// ẍ = 200 u − 30 ẋ − 4 sign(ẋ), in small steps, under a torque that vanishes at once and rises slowly the
/// other way.
struct LoneMotion {
  std::vector<double> u, x1;

  explicit LoneMotion(double dry_while_it_arrives) {
    double x = 0.0, v = 0.0;
    for (int i = 0; i < 600; ++i) {
      u.push_back(i < 250 ? 0.1 : i < 350 ? 0.0 : -1e-3 * (i - 350));
      x1.push_back(x);
      const double dry = i < 350 ? dry_while_it_arrives : 4.0;
      for (int k = 0; k < 100; ++k) {
        const double pushed = v + 1e-5 * (200.0 * u.back() - 30.0 * v);
        v = std::copysign(std::max(std::abs(pushed) - 1e-5 * dry, 0.0), pushed);
        x += 1e-5 * v;
      }
    }
  }
  double squares(const LoneLaw& start) const {
    const LoneStretch stretch{255, 500};
    return lone_motor_squares({"lone", 0.0, 1e-3, u, x1}, {&stretch, 1}, start);
  }
};

constexpr LoneLaw kGuess{150.0, 20.0, 0.0};

TEST(LoneMotor, IsFollowedThroughItsRest) {
  const LoneMotion motion(4.0);
  EXPECT_LT(std::sqrt(motion.squares(kGuess) / 246.0), 1e-3 * std::abs(motion.x1[500] - motion.x1[350]));
}

TEST(LoneMotor, ThatRestsAtSomethingThatBrakesItIsNotFollowed) {
  EXPECT_GT(LoneMotion(12.0).squares(kGuess), 100.0 * LoneMotion(4.0).squares(kGuess));
}

TEST(LoneMotor, ALawThatIsNotDrivenFollowsNothing) {
  EXPECT_TRUE(std::isinf(LoneMotion(4.0).squares({0.0, 20.0, 0.0})));
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

}  // namespace
}  // namespace gapscope::internal::sliding_mode
