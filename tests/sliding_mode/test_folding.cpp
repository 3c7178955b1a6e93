#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gapscope/base/random.h"
#include "gapscope/base/statistics.h"
#include "sliding_mode/folding.h"
#include "sliding_mode/signal_facts.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Two harmonics with a period that is no whole number of samples, read through a coarse and noisy encoder.
struct Periodic {
  double period = 0.7313, dt = 1e-3, quantum = 1e-3, noise = 0.0;
  std::vector<double> u, x1;

  double truth(double t) const {
    const double phase = 2.0 * kPi * t / period;
    return 0.1 * std::sin(phase) + 0.02 * std::cos(3.0 * phase);
  }
  MotorTrace trace(double seconds, double drift = 0.0) {
    auto generator = random_stream(1, "folding");
    for (int i = 0; i * dt < seconds; ++i) {
      const double t = i * dt, x = truth(t) + drift * t + noise * normal(generator);
      u.push_back(std::sin(2.0 * kPi * t / period));
      x1.push_back(quantum > 0.0 ? quantum * std::round(x / quantum) : x);
    }
    return {"periodic.csv", 0.0, dt, u, x1, quantum};
  }
};

TEST(Folding, ThePeriodOfTheInputIsFoundBetweenTheSamples) {
  Periodic p;
  EXPECT_NEAR(input_period(p.trace(6.0), 4.0), p.period, 1e-3 * p.dt);
}

TEST(Folding, AnInputThatDoesNotRepeatItselfHasNoPeriod) {
  Periodic p;
  MotorTrace trace = p.trace(6.0);
  for (std::size_t i = 0; i < p.u.size(); ++i)
    p.u[i] = std::sin(std::pow(0.004 * static_cast<double>(i), 1.7));
  EXPECT_EQ(input_period(trace, 4.0), 0.0);
  EXPECT_EQ(fold(trace).periods, 0u);
}

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

TEST(Folding, PeriodsThatReadAlikeToTheLastCountShareTheirRounding) {
  Periodic p;
  p.period = 0.75;  // 750 samples: every period is rounded in the same way
  const FoldedMotion f = fold(p.trace(6.0));
  ASSERT_GT(f.periods, 0u);
  EXPECT_NEAR(f.noise, p.quantum / std::sqrt(12.0), 1e-9);
}

TEST(SignalFacts, ADriftFromPeriodToPeriodIsNoPartOfTheMotion) {
  Periodic still, drifting;
  const SignalFacts expected = read_facts(still.trace(6.0)), facts = read_facts(drifting.trace(6.0, 0.4));
  EXPECT_EQ(facts.defect, "");
  EXPECT_EQ(facts.half_periods, expected.half_periods);
  EXPECT_NEAR(facts.half_period, expected.half_period, 0.01 * expected.half_period);
  EXPECT_NEAR(facts.travel, expected.travel, 0.02 * expected.travel);
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
