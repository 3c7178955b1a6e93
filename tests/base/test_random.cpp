#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace gapscope {
namespace {

TEST(Random, SameSeedAndPurposeDrawTheSameNumbers) {
  auto a = random_stream(7, "noise");
  auto b = random_stream(7, "noise");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a(), b());
}

TEST(Random, StreamsOfDifferentPurposeOrSeedDiffer) {
  auto a = random_stream(7, "noise");
  auto b = random_stream(7, "phases");
  auto c = random_stream(8, "noise");
  const auto first = a();
  EXPECT_NE(first, b());
  EXPECT_NE(first, c());
}

TEST(Random, NormalHasZeroMeanAndUnitVariance) {
  auto generator = random_stream(1, "normal");
  const int n = 100000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double v = normal(generator);
    sum += v;
    squares += v * v;
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));            // four standard errors
  EXPECT_NEAR(squares / n, 1.0, 4.0 * std::sqrt(2.0 / n));  // Var(v²) = 2
}

TEST(Random, UniformAndLogUniformStayInsideTheirLimits) {
  auto generator = random_stream(1, "uniform");
  for (int i = 0; i < 10000; ++i) {
    const double v = uniform(generator, -2.0, 3.0);
    EXPECT_GE(v, -2.0);
    EXPECT_LT(v, 3.0);
    const double w = log_uniform(generator, 0.1, 10.0);
    EXPECT_GE(w, 0.1);
    EXPECT_LE(w, 10.0);
  }
}

}  // namespace
}  // namespace gapscope
