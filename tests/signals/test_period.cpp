#include <gtest/gtest.h>

#include <algorithm>

#include "signals/period.h"
#include "signals/periodic.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

TEST(Period, OfTheInputIsFoundBetweenTheSamples) {
  Periodic p;
  EXPECT_NEAR(exact_period(p.trace(6.0), 4.0), p.period, 1e-3 * p.dt);
}

TEST(Period, AnInputThatDoesNotRepeatItselfHasNoPeriod) {
  Periodic p;
  MotorTrace trace = p.trace(6.0);
  for (std::size_t i = 0; i < p.u.size(); ++i)
    p.u[i] = std::sin(std::pow(0.004 * static_cast<double>(i), 1.7));
  EXPECT_EQ(exact_period(trace, 4.0), 0.0);
  EXPECT_EQ(rough_period(trace), 0u);
}

TEST(Period, AnInputThatRepeatsItselfRoughlyHasARoughPeriodOnly) {
  Periodic p;
  MotorTrace trace = p.trace(6.0);
  EXPECT_EQ(rough_period(trace), 731u);
  auto generator = random_stream(1, "period");
  for (double& u : p.u) u += 0.05 * normal(generator);  // 7 % of its rms: below 15 %, above the root of 0.1 %
  EXPECT_EQ(exact_period(trace, 4.0), 0.0);
  EXPECT_NEAR(static_cast<double>(rough_period(trace)), 731.3, 10.0);
}

TEST(Period, AnAmplitudeThatChangesOnTheWayIsAnotherInput) {
  Periodic p;
  MotorTrace trace = p.trace(8.0);
  const auto half = static_cast<std::ptrdiff_t>(p.u.size() / 2);
  std::for_each(p.u.begin() + half, p.u.end(), [](double& u) { u *= 1.4; });
  EXPECT_EQ(rough_period(trace), 0u);
}

TEST(Period, OneThatEndsWithTheRecordingIsNotComparedWithWhatIsNotThere) {
  Periodic p;
  const MotorTrace trace = p.trace(2.0 * p.period);
  EXPECT_EQ(exact_period(trace, 1.9), 0.0);  // reads within the samples: for the sanitizer
}

TEST(Period, OfATriangleIsTheSameFromTheInputAsItIs) {
  std::vector<double> u;
  for (int i = 0; i < 6000; ++i) u.push_back(std::asin(std::sin(2.0 * kPi * 0.7 * 0.002 * i)));
  const MotorTrace trace{"triangle.csv", 0.0, 0.002, u, u, 0.0};
  EXPECT_NEAR(input_period(trace), 1.0 / (0.7 * 0.002), 0.01);  // 714.29 samples, not twice 714
  EXPECT_LT(repetition_error(u, 0, input_period(trace)), 1e-3);
}

TEST(Period, TwoRepetitionsAreEnoughForARoughOneOnly) {
  Periodic p;
  const MotorTrace trace = p.trace(2.1 * p.period);
  EXPECT_EQ(exact_period(trace, 4.0), 0.0);
  EXPECT_EQ(rough_period(trace), 731u);
}

TEST(Period, TheRepetitionErrorOfAWaveHalfAPeriodOnIsItsAmplitude) {
  std::vector<double> v;
  for (int i = 0; i < 1000; ++i) v.push_back(0.3 * std::sin(2.0 * kPi * i / 100.0));
  EXPECT_NEAR(repetition_error(v, 50, 100), 0.0, 1e-12);
  EXPECT_NEAR(repetition_error(v, 50, 50), 0.3, 1e-12);  // differs by 2 · 0.3/√2 rms, over √2
}

}  // namespace
}  // namespace gapscope::internal::signals
