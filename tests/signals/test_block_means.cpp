#include <gtest/gtest.h>

#include "signals/block_means.h"
#include "signals/periodic.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

SignalFacts facts_of(const Periodic& p, double noise) {
  SignalFacts facts;
  facts.half_period = 0.5 * p.period;
  facts.quantum = p.quantum;
  facts.noise = noise;
  return facts;
}

TEST(BlockMeans, AreCloserToTheTruthThanASampleByTheRootOfTheirWidthWhereNoiseDithers) {
  Periodic p;
  p.dt = 1e-4;
  p.noise = 1e-3;
  const double single = std::sqrt(p.noise * p.noise + p.quantum * p.quantum / 12.0);
  const MotorTrace trace = p.trace(5.0);
  const BlockMeans means = block_means(trace, facts_of(p, single));
  ASSERT_EQ(means.width, 10u) << "3656 samples in a half period, for 375 means";
  EXPECT_EQ(means.rounding, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < means.x1.size(); ++i)
    sum += std::pow(means.x1[i] - p.truth(means.start + static_cast<double>(i) * means.dt), 2);
  const double error = std::sqrt(sum / static_cast<double>(means.x1.size()));
  EXPECT_NEAR(means.noise / error, 1.0, 0.05);  // of 5000 means: ±1 % twice, and 4 % for rounding alike
}

TEST(BlockMeans, KeepTheRoundingOfSlowMotionWithoutDitherAndTakeNothingTogetherAtALowRate) {
  Periodic p;
  p.dt = 1e-4;
  const double rounding = p.quantum / std::sqrt(12.0);
  const MotorTrace trace = p.trace(2.0);
  EXPECT_EQ(block_means(trace, facts_of(p, rounding)).rounding, rounding);
  Periodic slow;  // 366 samples in a half period
  const MotorTrace coarse = slow.trace(2.0);
  EXPECT_EQ(block_means(coarse, facts_of(slow, rounding)).width, 0u);
}

}  // namespace
}  // namespace gapscope::internal::signals
