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
