#include <gtest/gtest.h>

#include "base/random.h"
#include "plant/impact.h"

namespace gapscope {
namespace {

TEST(Impact, UnitRestitutionIsEquation3) {
  auto generator = random_stream(1, "impact");
  for (int i = 0; i < 1000; ++i) {
    const double w1 = uniform(generator, -5, 5), w2 = uniform(generator, -5, 5);
    const double mass_ratio = log_uniform(generator, 0.1, 10), alpha = -mass_ratio;
    const double published = (w1 * (1 + alpha) - 2 * alpha * w2) / (1 - alpha);
    EXPECT_NEAR(speeds_after_impact(w1, w2, mass_ratio, 1.0).first, published,
                1e-13);  // a few ulp of 5 rad/s
  }
}

TEST(Impact, MomentumIsKeptForEveryRestitutionAndEnergyForAnElasticOne) {
  auto generator = random_stream(2, "impact");
  for (int i = 0; i < 1000; ++i) {
    const double w1 = uniform(generator, -5, 5), w2 = uniform(generator, -5, 5);
    const double mu = log_uniform(generator, 0.1, 10), e = uniform(generator, 0, 1);
    const auto [v1, v2] = speeds_after_impact(w1, w2, mu, e);
    EXPECT_NEAR(v1 + mu * v2, w1 + mu * w2, 1e-12);
    EXPECT_NEAR(v1 - v2, -e * (w1 - w2), 1e-12);
    const auto [s1, s2] = speeds_after_impact(w1, w2, mu, 1.0);
    EXPECT_NEAR(s1 * s1 + mu * s2 * s2, w1 * w1 + mu * w2 * w2, 1e-10);
  }
}

}  // namespace
}  // namespace gapscope
