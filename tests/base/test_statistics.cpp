#include <gtest/gtest.h>

#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

TEST(Statistics, QuantilesInterpolateBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_DOUBLE_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_DOUBLE_EQ(quantile({0.0, 10.0}, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile({5.0, 1.0, 3.0}, 1.0), 5.0);
}

TEST(Statistics, NoValuesGiveNaNRatherThanZero) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(rms({})));
  EXPECT_TRUE(std::isnan(robust_std({})));
}

TEST(Statistics, RobustStdIgnoresAnOutlier) {
  EXPECT_DOUBLE_EQ(robust_std({1.0, 2.0, 3.0, 4.0, 1e9}), 1.4826);
}

TEST(Statistics, WilsonLimitsSolveTheirQuadratic) {
  // The limits are the p at which |k/n − p| = z √(p (1 − p)/n) (Wilson 1927).
  const int k = 33, n = 200;
  const double z = 1.96;
  const Interval limits = wilson(k, n, z);
  for (const double p : {limits.low, limits.high})
    EXPECT_NEAR(std::abs(static_cast<double>(k) / n - p), z * std::sqrt(p * (1 - p) / n), 1e-12);
  EXPECT_NEAR(wilson(0, 210).low, 0.0, 1e-15);
  EXPECT_GT(wilson(0, 210).high, 0.01);
}

}  // namespace
}  // namespace gapscope
