#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "signals/noise.h"

namespace gapscope::internal::signals {
namespace {

TEST(Noise, OfASmoothMotionIsThatOfItsSamplesInBothWays) {
  auto generator = random_stream(1, "noise");
  std::vector<double> y;
  for (int i = 0; i < 20000; ++i) y.push_back(std::sin(0.01 * i) + 1e-4 * normal(generator));
  // The median of n has a standard error of 1.2/√n of σ, and neighbours share samples.
  EXPECT_NEAR(noise_from_differences(y), 1e-4, 0.03e-4);
  EXPECT_NEAR(noise_about_motion(y), 1e-4, 0.03e-4);
}

TEST(Noise, OfUnevenSamplesIsNoneOfTheMotionBetweenThem) {
  auto generator = random_stream(2, "noise");
  std::vector<double> y, t;
  for (int i = 0; i < 20000; ++i) {
    t.push_back(i + 0.3 * uniform(generator, -1.0, 1.0) + (i > 5000 ? 40.0 : 0.0));
    y.push_back(std::sin(0.01 * t.back()) + 1e-4 * normal(generator));
  }
  EXPECT_NEAR(noise_about_motion(y, t), 1e-4, 0.03e-4);
  EXPECT_GT(noise_about_motion(y), 2e-4);  // which counts the jitter of the steps as noise
}

TEST(Noise, OfEvenStampsIsThatOfNone) {
  auto generator = random_stream(3, "noise");
  std::vector<double> y, t;
  for (int i = 0; i < 1000; ++i) t.push_back(i), y.push_back(normal(generator));
  EXPECT_NEAR(noise_about_motion(y, t), noise_about_motion(y), 1e-12);
}

TEST(Noise, WhatFourthDifferencesHaveInCommonIsNoiseToTheOneAndNoneToTheOther) {
  std::vector<double> y;
  for (int i = 0; i < 100; ++i) y.push_back(std::pow(i, 4));
  for (const double d : fourth_differences(y)) EXPECT_EQ(d, 24.0);
  EXPECT_NEAR(noise_from_differences(y), 1.4826 * 24.0 / std::sqrt(70.0), 1e-12);
  EXPECT_LT(noise_about_motion(y), 1e-8);
}

TEST(Noise, AboutAMotionIsThatOfItsSamplesWhereTheMotionTurnsWithinTen) {
  auto generator = random_stream(4, "noise");
  std::vector<double> y;
  for (int i = 0; i < 20000; ++i) y.push_back(1e-3 * std::sin(0.6 * i) + 1e-4 * normal(generator));
  EXPECT_NEAR(noise_about_motion(y), 1e-4, 0.05e-4);
}

TEST(Noise, OfWholeCountsIsThatOfRoundingAndNoiseTogether) {
  for (const double sigma : {0.2, 0.5, 1.0}) {  // counts
    auto generator = random_stream(5, "noise");
    std::vector<double> y;
    for (int i = 0; i < 20000; ++i)
      y.push_back(std::round(2000.0 * std::sin(0.006 * i) + sigma * normal(generator)));
    EXPECT_NEAR(noise_about_motion(y), std::hypot(sigma, 1.0 / std::sqrt(12.0)), 0.05) << sigma;
  }
}

TEST(Noise, OfFewSamplesIsUnknown) {
  const double y[] = {1.0, 2.0, 3.0, 4.0};
  EXPECT_TRUE(std::isnan(noise_from_differences(y)));
  EXPECT_TRUE(std::isnan(noise_about_motion(y)));
}

}  // namespace
}  // namespace gapscope::internal::signals
