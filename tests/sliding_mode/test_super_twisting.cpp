#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

#include "base/random.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "sliding_mode/bound_bank.h"

namespace {
std::atomic<long> allocations{0};
}

// Counts what the test program allocates; everything else is as usual. (Inlined, GCC takes malloc for a
// mismatch.)
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace gapscope {
namespace {

using enum Discretisation;
constexpr Discretisation kAll[] = {kForwardEuler, kSemiImplicit, kImplicit, kMatched};

struct Worst {
  double error = 0.0, velocity = 0.0;
};

/// Largest |e| and |ŵ − ẏ| for y = sin t + noise in [2, 10] s, after the transient.
Worst follow_sine(double L, double dt, Discretisation discretisation, double noise = 0.0) {
  SuperTwistingDifferentiator differentiator(L, discretisation);
  auto generator = random_stream(3, "bounded noise");
  Worst worst;
  for (int i = 0; dt * i < 10.0; ++i) {
    const double t = dt * i;
    const auto z = differentiator.step(std::sin(t) + noise * uniform(generator, -1.0, 1.0), dt);
    if (t < 2.0) continue;
    worst.error = std::max(worst.error, std::abs(z.error));
    worst.velocity = std::max(worst.velocity, std::abs(z.velocity - std::cos(t)));
  }
  return worst;
}

TEST(SuperTwisting, GainsFollowTheRuleOfTheSource) {
  const SuperTwistingGains gains = SuperTwistingGains::from_bound(100.0);
  EXPECT_DOUBLE_EQ(gains.k2, 110.0);
  EXPECT_DOUBLE_EQ(gains.k1, 2.028 * std::sqrt(110.0));
  // The stability matrix [−k₁/2, 1/2; −k₂, 0] has eigenvalues in the left half plane: trace < 0 <
  // determinant.
  EXPECT_LT(-0.5 * gains.k1, 0.0);
  EXPECT_GT(0.5 * gains.k2, 0.0);
}

TEST(SuperTwisting, ABoundThatIsNotPositiveIsRefused) {
  for (const double L : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(SuperTwistingDifferentiator{L}, std::invalid_argument) << L;
  const std::vector<double> bounds{1.0, 0.0};
  EXPECT_THROW(BoundBank{bounds}, std::invalid_argument);
}

TEST(SuperTwisting, ForwardEulerChattersInProportionToTheSquareOfTheStep) {
  // |e| = O(L dt²), velocity error = O(L dt): halving the step quarters the one and halves the other. The
  // constants are those of a limit cycle and vary a little with where the samples fall, hence 25 %.
  for (const double L : {2.0, 8.0}) {
    const Worst coarse = follow_sine(L, 1e-3, kForwardEuler), fine = follow_sine(L, 0.5e-3, kForwardEuler);
    EXPECT_NEAR(coarse.error / fine.error, 4.0, 1.0) << L;
    EXPECT_NEAR(coarse.velocity / fine.velocity, 2.0, 0.5) << L;
    EXPECT_LT(coarse.error, 3.0 * L * 1e-6);
    EXPECT_LT(coarse.velocity, 3.0 * L * 1e-3);
  }
}

TEST(SuperTwisting, SetValuedStepsDoNotChatter) {
  // With |ÿ| < L the set-valued sign takes up all of the prediction error: e = 0, and ŵ lags by half a step.
  const double dt = 1e-3;
  for (const Discretisation d : {kSemiImplicit, kImplicit}) {
    const Worst worst = follow_sine(2.0, dt, d);
    EXPECT_LT(worst.error, 1e-12) << to_string(d);
    EXPECT_LT(worst.velocity, 1.0 * dt) << to_string(d);  // |ÿ| ≤ 1: half a step of lag is dt/2
  }
}

TEST(SuperTwisting, OnARampAllStepsButForwardEulerComeToRestExactly) {
  // y = w t is a fixed point of the set-valued and the matched steps; forward Euler ends in a limit cycle.
  for (const Discretisation d : kAll) {
    SuperTwistingDifferentiator differentiator(2.0, d);
    double last = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const auto z = differentiator.step(0.3 * 1e-3 * i, 1e-3);
      if (i > 10000) last = std::max({last, std::abs(z.error), 1e-3 * std::abs(z.velocity - 0.3)});
    }
    if (d == kForwardEuler)
      EXPECT_GT(last, 0.1 * 2.0 * 1e-6);
    else
      EXPECT_LT(last, 1e-14) << to_string(d);
  }
}

TEST(SuperTwisting, TheVelocityErrorOfEveryStepIsOfFirstOrder) {
  for (const Discretisation d : kAll) {
    const double coarse = follow_sine(2.0, 1e-3, d).velocity, fine = follow_sine(2.0, 0.25e-3, d).velocity;
    EXPECT_NEAR(coarse / fine, 4.0, 1.0) << to_string(d);
  }
}

TEST(SuperTwisting, AnImplicitStepSolvesItsSetValuedEquation) {
  // e + dt k₁ √|e| σ + dt² k₂ σ = b with σ ∈ sign(e), where dt k₂ σ is what ŵ₁ gains.
  const double L = 5.0, dt = 1e-3;
  const SuperTwistingGains g = SuperTwistingGains::from_bound(L);
  SuperTwistingDifferentiator differentiator(L, kImplicit);
  auto generator = random_stream(7, "implicit");
  auto before = differentiator.step(0.0, dt);
  for (int i = 0; i < 2000; ++i) {
    const double y = before.position + dt * before.velocity + (i % 2 ? 1e-6 : 1e-2) * normal(generator);
    const auto after = differentiator.step(y, dt);
    const double sigma = (after.velocity - before.velocity) / (dt * g.k2);
    const double b = y - before.position - dt * before.velocity;
    EXPECT_LE(std::abs(sigma), 1.0 + 1e-9);
    if (after.error != 0.0) {
      EXPECT_NEAR(sigma, after.error > 0.0 ? 1.0 : -1.0, 1e-9);
    }
    EXPECT_NEAR(after.error + dt * (g.k1 * std::sqrt(std::abs(after.error)) + dt * g.k2) * sigma, b, 1e-14);
    before = after;
  }
}

TEST(SuperTwisting, MatchedStepsStayBoundedWhereForwardEulerChattersMore) {
  for (const double dt : {1e-3, 0.5e-3}) {
    const double L = 8.0;
    EXPECT_LT(follow_sine(L, dt, kMatched).error, follow_sine(L, dt, kForwardEuler).error) << dt;
  }
}

TEST(SuperTwisting, UnderBoundedNoiseTheVelocityErrorIsOfTheOrderOfTheRootOfLTimesNoise) {
  // Levant's bound: |ŵ − ẏ| ≤ μ √(L ε), μ a constant near 2; sampling adds O(L dt).
  const double L = 2.0, dt = 1e-4;
  for (const double epsilon : {1e-4, 1e-3})
    for (const Discretisation d : kAll) {
      const double error = follow_sine(L, dt, d, epsilon).velocity;
      EXPECT_LT(error, 2.5 * std::sqrt(L * epsilon) + 3.0 * L * dt) << to_string(d) << " " << epsilon;
      EXPECT_GT(error, 0.05 * std::sqrt(L * epsilon)) << to_string(d) << " " << epsilon;
    }
}

TEST(SuperTwisting, ScalingPositionAndBoundByFourScalesEverythingBitForBit) {
  for (const Discretisation d : kAll) {
    SuperTwistingDifferentiator one(3.0, d), four(12.0, d);
    auto generator = random_stream(1, "scaling");
    for (int i = 0; i < 5000; ++i) {
      const double y = std::sin(1e-3 * i) + 1e-4 * normal(generator);
      const auto a = one.step(y, 1e-3), b = four.step(4.0 * y, 1e-3);
      ASSERT_EQ(4.0 * a.position, b.position) << to_string(d) << " " << i;
      ASSERT_EQ(4.0 * a.velocity, b.velocity) << to_string(d) << " " << i;
      ASSERT_EQ(4.0 * a.error, b.error) << to_string(d) << " " << i;
    }
  }
}

TEST(SuperTwisting, NegatingThePositionNegatesEverythingBitForBit) {
  for (const Discretisation d : kAll) {
    SuperTwistingDifferentiator one(3.0, d), minus(3.0, d);
    for (int i = 0; i < 5000; ++i) {
      const double y = std::sin(1e-3 * i) + 0.2 * std::sin(17e-3 * i);
      const auto a = one.step(y, 1e-3), b = minus.step(-y, 1e-3);
      ASSERT_EQ(a.position, -b.position) << to_string(d) << " " << i;
      ASSERT_EQ(a.velocity, -b.velocity) << to_string(d) << " " << i;
      ASSERT_EQ(a.error, -b.error) << to_string(d) << " " << i;
    }
  }
}

TEST(SuperTwisting, UnderAConstantAccelerationBeyondTheBoundTheErrorFollowsItsClosedForm) {
  // Eqs. (7)–(8) with f + ξ = a > k₂ from rest: e = c² t² solves ė + k₁ √e = e_w, ė_w = a − k₂ when
  // 2 c² + k₁ c = a − k₂. The sliding mode is lost, e_x grows as a parabola.
  const double L = 2.0, a = 12.0, dt = 1e-5;
  const SuperTwistingGains g = SuperTwistingGains::from_bound(L);
  const double c = (-g.k1 + std::sqrt(g.k1 * g.k1 + 8.0 * (a - g.k2))) / 4.0;
  for (const Discretisation d : kAll) {
    SuperTwistingDifferentiator differentiator(L, d);
    differentiator.start(0.0, 0.0);
    double e = 0.0, t = 0.0;
    for (int i = 1; i <= 50000; ++i) {
      t = dt * i;
      e = differentiator.step(0.5 * a * t * t, dt).error;
    }
    // First-order steps: relative error a few dt/t times the logarithm of the number of steps.
    EXPECT_NEAR(e / (c * c * t * t), 1.0, 1e-3) << to_string(d);
  }
}

TEST(SuperTwisting, AVelocityStepLeavesThePeakThatEqSevenAndEightPredict) {
  // e_w = Δv at once, then ė = e_w − k₁ √e, ė_w = −k₂. Scaling e by Δv²/k₂ and t by Δv/k₂ leaves only
  // k₁/√k₂ = 2.028; integrating that finely gives the peak as a multiple of Δv²/k₂.
  double e = 0.0, w = 1.0, peak = 0.0;
  for (const double h = 1e-6; w > 0.0; w -= h) {
    e += h * (w - 2.028 * std::sqrt(e));
    peak = std::max(peak, e);
  }
  EXPECT_NEAR(peak, kStepPeak, 0.001);
  const double L = 5.0, step = 0.5, k2 = 1.1 * L;
  for (const Discretisation d : kAll) {
    SuperTwistingDifferentiator differentiator(L, d);
    differentiator.start(0.0, 0.0);
    double seen = 0.0;
    for (int i = 1; i < 20000; ++i) seen = std::max(seen, differentiator.step(step * 1e-5 * i, 1e-5).error);
    EXPECT_NEAR(seen, peak * step * step / k2, 0.005 * peak * step * step / k2) << to_string(d);
  }
}

TEST(SuperTwisting, AStepNeitherAllocatesNorThrows) {
  SuperTwistingDifferentiator one(5.0, kMatched);
  const std::vector<double> bounds{1.0, 2.0, 4.0, 8.0, 16.0};
  BoundBank bank(bounds);
  static_assert(noexcept(one.step(0.0, 1.0))&& noexcept(bank.step(0.0, 1.0)));
  const std::vector<double> y(1000, 0.5);
  std::vector<double> errors(y.size() * bounds.size());
  const long before = allocations;
  for (int i = 0; i < 1000; ++i) {
    one.step(1e-3 * i, 1e-3);
    bank.step(1e-3 * i, 1e-3);
  }
  bank.run(y, 1e-3, errors);
  EXPECT_EQ(allocations, before);
  { const std::vector<double> counted(3); }
  EXPECT_GT(allocations, before) << "the counter itself counts";
}

TEST(BoundBank, EveryBoundGivesBitForBitWhatItGivesAlone) {
  const std::vector<double> bounds{0.5, 1.0, 3.0, 10.0, 40.0, 100.0, 333.0};
  for (const Discretisation d : kAll) {
    BoundBank bank(bounds, d);
    std::vector<SuperTwistingDifferentiator> alone;
    for (const double L : bounds) alone.emplace_back(L, d);
    auto generator = random_stream(2, "bank");
    for (int i = 0; i < 3000; ++i) {
      const double y = std::sin(2e-3 * i) + 1e-4 * normal(generator);
      bank.step(y, 4e-4);
      for (std::size_t j = 0; j < bounds.size(); ++j) {
        const auto z = alone[j].step(y, 4e-4);
        ASSERT_EQ(bank.errors()[j], z.error) << to_string(d) << " " << bounds[j] << " " << i;
        ASSERT_EQ(bank.velocities()[j], z.velocity);
        ASSERT_EQ(bank.positions()[j], z.position);
      }
    }
  }
}

TEST(BoundBank, ARunGivesTheErrorsOfItsSteps) {
  const std::vector<double> bounds{0.5, 3.0, 40.0, 100.0, 333.0};
  std::vector<double> y;
  for (int i = 0; i < 500; ++i) y.push_back(std::sin(2e-3 * i));
  for (const bool started : {false, true}) {
    BoundBank run(bounds), steps(bounds);
    if (started) run.start(-0.1, 1.0), steps.start(-0.1, 1.0);
    std::vector<double> errors(y.size() * bounds.size(), -1.0);
    run.run(y, 4e-4, errors);
    for (std::size_t i = 0; i < y.size(); ++i) {
      steps.step(y[i], 4e-4);
      for (std::size_t j = 0; j < bounds.size(); ++j)
        ASSERT_EQ(errors[i * bounds.size() + j], steps.errors()[j]) << i << " " << j;
    }
  }
}

}  // namespace
}  // namespace gapscope
