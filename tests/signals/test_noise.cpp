#include <gtest/gtest.h>

#include <cmath>

#include "gapscope/base/random.h"
#include "signals/noise.h"

namespace gapscope::internal::signals {
namespace {

TEST(Noise, OfASmoothMotionIsThatOfItsSamplesInBothWays) {
  auto generator = random_stream(1, "noise");
  std::vector<double> y;
  for (int i = 0; i < 20000; ++i) y.push_back(std::sin(0.01 * i) + 1e-4 * normal(generator));
  // The median of n has a standard error of 1.2/√n of σ, and neighbours share samples.
  EXPECT_NEAR(noise_from_differences(y), 1e-4, 0.03e-4);
  EXPECT_NEAR(noise_at_rest(y), 1e-4, 0.03e-4);
}

TEST(Noise, OfUnevenSamplesIsNoneOfTheMotionBetweenThem) {
  auto generator = random_stream(2, "noise");
  std::vector<double> y, t;
  for (int i = 0; i < 20000; ++i) {
    t.push_back(i + 0.3 * uniform(generator, -1.0, 1.0) + (i > 5000 ? 40.0 : 0.0));
    y.push_back(std::sin(0.01 * t.back()) + 1e-4 * normal(generator));
  }
  EXPECT_NEAR(noise_at_rest(y, t), 1e-4, 0.03e-4);
  EXPECT_GT(noise_at_rest(y), 2e-4);  // which counts the jitter of the steps as noise
}

TEST(Noise, OfEvenStampsIsThatOfNone) {
  auto generator = random_stream(3, "noise");
  std::vector<double> y, t;
  for (int i = 0; i < 1000; ++i) t.push_back(i), y.push_back(normal(generator));
  EXPECT_NEAR(noise_at_rest(y, t), noise_at_rest(y), 1e-12);
}

TEST(Noise, WhatFourthDifferencesHaveInCommonIsNoiseToTheOneAndNoneToTheOther) {
  std::vector<double> y;
  for (int i = 0; i < 100; ++i) y.push_back(std::pow(i, 4));
  for (const double d : fourth_differences(y)) EXPECT_EQ(d, 24.0);
  EXPECT_NEAR(noise_from_differences(y), 1.4826 * 24.0 / std::sqrt(70.0), 1e-12);
  EXPECT_EQ(noise_at_rest(y), 0.0);
}

TEST(Noise, AtRestIsThatOfTheSamplesHoweverJerkyTheMotionIsElsewhere) {
  auto generator = random_stream(4, "noise");
  std::vector<double> y;
  for (int i = 0; i < 20000; ++i) {
    const double speed = std::cos(0.01 * i), jerks = 1e-3 * std::sin(2.0 * i) * (std::abs(speed) > 0.5);
    y.push_back(std::sin(0.01 * i) + jerks + 1e-4 * normal(generator));
  }
  EXPECT_NEAR(noise_at_rest(y), 1e-4, 0.1e-4);
  EXPECT_GT(noise_from_differences(y), 2e-4);
}

TEST(Noise, OfLessThanFiveSamplesIsUnknown) {
  const double y[] = {1.0, 2.0, 3.0, 4.0};
  EXPECT_TRUE(std::isnan(noise_from_differences(y)));
}

}  // namespace
}  // namespace gapscope::internal::signals
