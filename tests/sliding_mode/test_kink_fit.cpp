#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "sliding_mode/kink_fit.h"

namespace gapscope::internal::sliding_mode {
namespace {

TEST(KinkFit, AnExactKinkIsFoundBetweenTheSamples) {
  const std::size_t first = 100;
  const double time = 131.3;
  for (const KinkShape& shape :
       {KinkShape{1}, KinkShape{2}, KinkShape{3}, KinkShape{0, 0.3, 0.1}, KinkShape{0, 0.0, 0.0, 0.4, 0.2}}) {
    std::vector<double> y(50);
    const double amplitude = -0.05 / shape(15.0);  // the same stroke for all
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double t = static_cast<double>(first + i);
      y[i] = 1.0 + 0.02 * t - 1e-4 * t * t + (t > time ? amplitude * shape(t - time) : 0.0);
    }
    const KinkFit fit = KinkScan(y, first, polynomial_columns(y.size(), 2)).best(shape, 110.0, 145.0);
    // The search ends at steps of 1/8 sample.
    EXPECT_NEAR(fit.time, time, 0.13) << shape.power;
    EXPECT_NEAR(fit.amplitude / amplitude, 1.0, 0.05) << shape.power;
  }
}

TEST(KinkFit, ASmoothPolynomialLeavesNothingForTheKink) {
  std::vector<double> y(60);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 3.0 + 0.1 * static_cast<double>(i * i);
  const KinkScan scan(y, 0, polynomial_columns(y.size(), 2));
  // Round-off of 60 values up to 350: (60 · 350 · 1e-16)² is far below 1e-18.
  EXPECT_LT(scan.smooth_sse(), 1e-18);
}

TEST(KinkFit, AKinkNeverFitsWorseThanThePolynomialAlone) {
  auto generator = random_stream(1, "kink");
  std::vector<double> y(40);
  for (int round = 0; round < 20; ++round) {
    for (double& v : y) v = normal(generator);
    const KinkScan scan(y, 0, polynomial_columns(y.size(), 2));
    EXPECT_LE(scan.best({1}, 5.0, 35.0).sse, scan.smooth_sse());
    EXPECT_LE(KinkScan(y, 0, polynomial_columns(y.size(), 3)).smooth_sse(), scan.smooth_sse() + 1e-12)
        << "a cubic contains the quadratic";
  }
}

TEST(KinkFit, TheElasticStrokeBeginsAsACubeAndEndsAsTheReboundOfFreeBodies) {
  const KinkShape undamped{0, 0.5, 0.0};
  const double omega = undamped.omega;
  // x − sin(ωx)/ω = ω²x³/6 − O(x⁵): relative rest (ωx)²/20.
  EXPECT_NEAR(undamped(0.1) / (omega * omega * 1e-3 / 6.0), 1.0, 0.05 * 0.05 / 20.0 * 1.1);
  // After the rebound the relative speed is reversed: the slope is 2, and 1 + e^(−πζ/√(1−ζ²)) with damping.
  EXPECT_NEAR(undamped(21.0) - undamped(20.0), 2.0, 1e-12);
  const KinkShape damped{0, 0.5, 0.3};
  EXPECT_NEAR(damped(31.0) - damped(30.0), 1.0 + std::exp(-std::acos(-1.0) * 0.3 / std::sqrt(0.91)), 1e-12);
}

TEST(KinkFit, BouncesBeginWithTheFirstKnockAndEndWithTheWholeOfTheSpeedLost) {
  const KinkShape bounces{0, 0.0, 0.0, 0.4, 0.1};
  // x − 0.6(1 − e^(−0.1x))/0.1 = 0.4x + 0.03x² − O(x³): relative rest 0.075x.
  EXPECT_NEAR(bounces(1e-3) / 0.4e-3, 1.0, 1e-4);
  EXPECT_NEAR(bounces(201.0) - bounces(200.0), 1.0, 1e-8);
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
