// Loops of drives whose motor coasts: what of them is no lost motion, and no gap.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "sliding_mode/verdict/loop_verdict.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

/// x1 goes over 40 mrad in a third of each half period of u, that long after the zero [share of the half
/// period].
LostMotion late_passage(double after) {
  std::vector<double> u, x1;
  for (int i = 0; i < 10000; ++i) {
    const double half = i / 500.0, phase = half - std::floor(half);
    const double way = std::clamp((phase - after) / 0.33, 0.0, 1.0),
                 sign = std::fmod(half, 2.0) < 1.0 ? 1.0 : -1.0;
    u.push_back(sign * std::sin(kPi * phase));
    x1.push_back(std::round(sign * 0.04 * (way - 0.5) / 1e-6) * 1e-6);
  }
  const MotorTrace trace{"late.csv", 0.0, 1e-3, u, x1, 1e-6};
  return detect_gap({&trace, 1}).lost_motion;
}

TEST(CoastingLoop, ThatIsTheWholeTravelOfADriveThatCoastsHasNoFlankAndIsNotTold) {
  EXPECT_FALSE(late_passage(0.23).read());
}

TEST(CoastingLoop, OfWhichAReadGapIsTheSmallerPartIsToldByTheseTwoNumbers) {
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kBacklash;
  estimate.gap = 0.0186, estimate.ci95 = {0.0176, 0.0196};
  estimate.lost_motion.value = 0.0445, estimate.lost_motion.levels.resize(1);
  estimate.lost_motion.cause = LostMotionCause::kGap;
  internal::sliding_mode::hold_against_gap(estimate);
  EXPECT_EQ(estimate.lost_motion.cause, LostMotionCause::kOpen);
  EXPECT_THAT(estimate.lost_motion.meaning.text(),
              HasSubstr("of 44.5 mrad lost motion the gap is 18.6 mrad"));
  estimate.lost_motion.value = 0.021, estimate.lost_motion.cause = LostMotionCause::kGap;
  internal::sliding_mode::hold_against_gap(estimate);
  EXPECT_EQ(estimate.lost_motion.cause, LostMotionCause::kGap);
}

}  // namespace
}  // namespace gapscope
