#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "report/signals.h"

namespace gapscope::internal::report {
namespace {

TEST(Autocorrelation, OfAnAlternatingSequenceHasAClosedForm) {
  // x_i = (−1)^i, n even, mean 0: r_k = (−1)^k (n − k)/n.
  const std::size_t n = 40;
  std::vector<double> x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(i % 2 ? -1.0 : 1.0);
  const auto r = autocorrelation(x, 10);
  ASSERT_EQ(r.size(), 11u);
  for (std::size_t k = 0; k <= 10; ++k)
    EXPECT_NEAR(r[k], (k % 2 ? -1.0 : 1.0) * (40.0 - static_cast<double>(k)) / 40.0, 1e-14);
}

TEST(Autocorrelation, DoesNotSeeAnOffset) {
  std::vector<double> x, shifted;
  for (int i = 0; i < 100; ++i) {
    x.push_back(std::sin(i * 0.3));
    shifted.push_back(x.back() + 8.0);
  }
  const auto a = autocorrelation(x, 20), b = autocorrelation(shifted, 20);
  for (std::size_t k = 0; k <= 20; ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
}

TEST(Autocorrelation, OfWhiteNoiseStaysInItsBandAsOftenAsItSays) {
  constexpr int n = 20000, lags = 400;
  auto generator = random_stream(3, "noise");
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(normal(generator));
  const auto r = autocorrelation(x, lags);
  int inside = 0;
  for (std::size_t k = 1; k <= lags; ++k) inside += std::abs(r[k]) < 1.96 / std::sqrt(n);
  // 95 % of 400 independent values: 380 ± 4.4; five standard deviations.
  EXPECT_NEAR(inside, 380, 22);
}

TEST(MiddleCrossings, CountTwoAPeriodDespiteChatter) {
  auto generator = random_stream(4, "chatter");
  std::vector<double> x;
  for (int i = 0; i < 5000; ++i)
    x.push_back(3.0 + std::sin(2.0 * kPi * i / 500.0) + 0.02 * uniform(generator, -1.0, 1.0));
  const auto crossings = middle_crossings(x);
  ASSERT_GE(crossings.size(), 18u);
  for (std::size_t i = 1; i < crossings.size(); ++i)
    EXPECT_NEAR(static_cast<double>(crossings[i] - crossings[i - 1]), 250.0, 12.0);
  EXPECT_TRUE(middle_crossings({}).empty());
}

TEST(RoundFactor, BringsASizeJustBelowItsTarget) {
  EXPECT_DOUBLE_EQ(round_factor(1.0, 60.0), 50.0);
  EXPECT_DOUBLE_EQ(round_factor(2.3e-3, 68e-3), 20.0);
  EXPECT_DOUBLE_EQ(round_factor(4.0, 1.0), 0.2);
  EXPECT_DOUBLE_EQ(round_factor(0.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_factor(1.0, kNaN), 1.0);
}

TEST(MovingMean, KeepsStraightLinesAndHalvesWhatAlternates) {
  std::vector<double> line, alternating;
  for (int i = 0; i < 50; ++i) {
    line.push_back(0.3 * i - 2.0);
    alternating.push_back(i % 2 ? 1.0 : -1.0);
  }
  const auto same = moving_mean(line, 4);  // symmetric up to the ends
  for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(same[i], line[i], 1e-12);
  const auto less = moving_mean(alternating, 4);
  for (std::size_t i = 4; i < 46; ++i) EXPECT_NEAR(std::abs(less[i]), 1.0 / 9.0, 1e-12);
}

TEST(PeakToPeak, IgnoresUndefinedSamples) {
  EXPECT_DOUBLE_EQ(peak_to_peak(std::vector<double>{kNaN, 1.0, -2.0, kNaN}), 3.0);
  EXPECT_DOUBLE_EQ(largest_magnitude(std::vector<double>{1.0, kNaN, -2.0}), 2.0);
}

}  // namespace
}  // namespace gapscope::internal::report
