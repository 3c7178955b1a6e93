// A torque that repeats with the motor angle, at any period, on the independent plant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/one_inertia.h"
#include "diagnosis/periodic_torque.h"

namespace gapscope {
namespace {

using namespace internal::diagnosis;

constexpr double kCycles = 13.7;  // no whole number of cycles per turn

/// What periodic torque the nominal model, fitted, leaves.
std::vector<PeriodicTorque> left_by_nominal(double cogging, const DiagnosisKnowledge& known = {}) {
  independent_plant::MotorEffects effects;
  effects.cogging = {cogging, kCycles, 0.4, 0.0};
  const blind::BlindPair pair = test::one_inertia(effects, 500021);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  DiagnosisOptions options;
  options.known = known;
  const Study study = make_study(train, held_out, pair.sheet, options);
  const FittedModel nominal = fit_nominal(train, pair.sheet, {}, kMeasure.slow_hz);
  return periodic_torques(study, nominal.model, play(nominal.model, study.held_out, kMeasure.slow_hz, true));
}

TEST(PeriodicTorque, IsFoundAtAPeriodThatNobodyHasGiven) {
  const std::vector<PeriodicTorque> found = left_by_nominal(0.01);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().periods_per_turn, kCycles, 0.01 * kCycles);
  EXPECT_NEAR(found.front().period, 2.0 * kPi / kCycles, 0.01 * 2.0 * kPi / kCycles);
  EXPECT_NEAR(found.front().amplitude, 0.01, 0.002);
  EXPECT_FALSE(found.front().given);
  EXPECT_TRUE(found.front().holds);
}

TEST(PeriodicTorque, IsNotFoundWhereThereIsNone) { EXPECT_TRUE(left_by_nominal(0.0).empty()); }

/// What an observer of two poles at 150 Hz, in continuous time, makes of a detent of 8 mN m, 12 per turn, on
/// a motion that comes to `fastest` [rad/s]: at 60 the detent is one of 115 Hz, and follows 75 degrees late.
std::vector<TorqueLine> lines_at_speed(double fastest) {
  constexpr int kSubsteps = 50;
  constexpr double kStep = 1e-3;
  std::vector<double> torque, x1;
  double first = 0.0, second = 0.0;
  const double pull = 2.0 * kPi * 150.0 * kStep / kSubsteps, turn = 2.0 * kPi * 0.7;
  for (int i = 0; i < 8000; ++i) {
    const auto angle = [&](double t) { return fastest / turn * (1.0 - std::cos(turn * t)); };
    x1.push_back(angle(kStep * i));
    torque.push_back(second + 1e-4 * std::sin(7.7 * i * i));
    for (int k = 0; k < kSubsteps; ++k) {
      const double detent = 8e-3 * std::sin(12.0 * angle(kStep * (i + (k + 0.5) / kSubsteps)) + 0.3);
      second += pull * (first - second), first += pull * (detent - first);
    }
  }
  const std::vector<double> u(x1.size(), 0.0);
  MotorTrace trace;
  trace.dt = kStep, trace.x1 = x1, trace.u = u;
  return standing_lines({torque}, std::span(&trace, 1));
}

TEST(PeriodicTorque, IsFoundWhereTheObserverFollowsItLate) {
  for (const double fastest : {5.0, 60.0, 100.0}) {
    const std::vector<TorqueLine> lines = lines_at_speed(fastest);
    ASSERT_FALSE(lines.empty()) << fastest;
    EXPECT_NEAR(lines.front().line.periods, 12.0, 0.05) << fastest;
    EXPECT_NEAR(std::hypot(lines.front().line.sine, lines.front().line.cosine), 8e-3, 2e-4) << fastest;
    EXPECT_NEAR(std::atan2(lines.front().line.cosine, lines.front().line.sine), 0.3, 0.05) << fastest;
  }
}

TEST(PeriodicTorque, IsToldAtEveryGivenPeriodAndHoldsOnlyWhereItIs) {
  DiagnosisKnowledge known;
  known.periods_per_turn = {kCycles, 50.0};
  const std::vector<PeriodicTorque> found = left_by_nominal(0.01, known);
  ASSERT_GE(found.size(), 2u);
  EXPECT_TRUE(found[0].given);
  EXPECT_TRUE(found[0].holds);
  EXPECT_EQ(found[1].periods_per_turn, 50.0);
  EXPECT_FALSE(found[1].holds);
  for (std::size_t i = 2; i < found.size(); ++i)
    EXPECT_GT(std::abs(found[i].periods_per_turn - kCycles), 0.01 * kCycles);
}

}  // namespace
}  // namespace gapscope
