#include <gtest/gtest.h>

#include "signals/folding.h"
#include "signals/periodic.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

TEST(Folding, TheMeanIsCloserToTheTruthThanOnePeriodByTheRootOfTheirNumber) {
  Periodic p;
  p.noise = 0.5e-3;
  const FoldedMotion f = fold(p.trace(8.0 * 0.7313 + 0.01));
  ASSERT_GE(f.periods, 7u);
  double sum = 0.0;
  for (std::size_t b = 0; b < f.mean.size(); ++b)
    sum += std::pow(f.mean[b] - p.truth(f.start + (static_cast<double>(b) + 0.5) * f.dt), 2);
  const double error = std::sqrt(sum / static_cast<double>(f.mean.size()));
  const double single = std::sqrt(p.noise * p.noise + p.quantum * p.quantum / 12.0);
  EXPECT_LT(error, 1.2 * single / std::sqrt(7.0));
  EXPECT_NEAR(f.noise / error, 1.0, 0.25) << "what it says of its noise holds";
}

TEST(Folding, TheMeanEndsWhereItBeginsAlsoWhenTheMotionDrifts) {
  Periodic p;
  p.quantum = 0.0;
  const FoldedMotion f = fold(p.trace(6.0, 2e-3));
  ASSERT_GT(f.periods, 0u);
  const double seam = f.tiled_x1[f.mean.size()] - f.tiled_x1[f.mean.size() - 1];
  const double inside = f.mean[1] - f.mean[0];
  EXPECT_NEAR(seam, inside, 0.05 * std::abs(inside));
}

TEST(Folding, AMotionThatWandersIsAsSteepInTheMeanAsItIs) {
  Periodic p;
  p.quantum = 0.0;
  const double creep = 2e-3;
  const FoldedMotion f = fold(p.trace(6.0, creep));
  ASSERT_GT(f.periods, 0u);
  const auto off = [&](std::size_t i) {
    const double t = f.start + (static_cast<double>(i) + 0.5) * f.dt;
    return f.tiled_x1[i] - p.truth(t) - creep * t;
  };
  for (std::size_t i = 1; i < f.tiled_x1.size(); i += 50)
    EXPECT_NEAR(off(i), off(0), 0.05 * creep * p.period);
}

TEST(Folding, PeriodsThatReadAlikeToTheLastCountShareTheirRounding) {
  Periodic p;
  p.period = 0.75;  // 750 samples: every period is rounded in the same way
  const FoldedMotion f = fold(p.trace(6.0));
  ASSERT_GT(f.periods, 0u);
  EXPECT_NEAR(f.noise, p.quantum / std::sqrt(12.0), 1e-9);
}

}  // namespace
}  // namespace gapscope::internal::signals
