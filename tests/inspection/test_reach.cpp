#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "inspection/reach.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// x1 = a sin(ω t), u = b cos(ω t), four seconds at 500 Hz.
Recording swung(double a, double omega, double b) {
  Recording r;
  r.dt = 0.002;
  for (int i = 0; i < 2000; ++i) {
    r.x1.push_back(a * std::sin(omega * r.dt * i));
    r.u.push_back(b * std::cos(omega * r.dt * i));
  }
  return r;
}

MotionReach reach(const Recording& r) {
  const MotorTrace trace = r.motor_trace();
  return reach_of({&trace, 1});
}

TEST(MotionReach, IsTheClosedFormOfASine) {
  const MotionReach r = reach(swung(0.5, 6.0, 2.0));
  EXPECT_NEAR(r.travel, 1.0, 1e-3);
  EXPECT_NEAR(r.speed, 3.0, 0.01) << "a sine spends 1 % of its time above 0.9999 of its peak";
  EXPECT_NEAR(r.input, 2.0, 1e-3);
}

TEST(MotionReach, CountsReversalsOfTheMotionAndNoneOfItsNoise) {
  Recording r = swung(0.5, 5.0, 2.0);  // 20 rad in four seconds, a crest every π
  EXPECT_EQ(reach(r).reversals, 6);
  for (std::size_t i = 0; i < r.x1.size(); ++i) r.x1[i] += 0.02 * (i % 2 == 0 ? 1.0 : -1.0);
  EXPECT_EQ(reach(r).reversals, 6);
}

TEST(MotionReach, OfSeveralIsTheFarthestOfEach) {
  const Recording wide = swung(0.5, 2.0, 1.0), fast = swung(0.1, 30.0, 2.0);
  const MotorTrace both[] = {wide.motor_trace(), fast.motor_trace()};
  const MotionReach r = reach_of(both);
  EXPECT_NEAR(r.travel, 1.0, 1e-3);
  EXPECT_GT(r.speed, 2.5);
  EXPECT_NEAR(r.input, 2.0, 1e-2);
}

TEST(MotionReach, ASpikeIsNoMotion) {
  Recording spiked = swung(0.5, 6.0, 2.0);
  spiked.u[700] = 100.0;
  EXPECT_NEAR(reach(spiked).input, 2.0, 1e-3);
}

TEST(GoesFarther, TellsTheNumbersOfWhatIsClearlyMoreAndNothingElse) {
  const MotionReach slow = reach(swung(0.5, 6.0, 2.0)), fast = reach(swung(0.5, 12.0, 2.0));
  const std::string told = goes_farther(slow, fast, {});
  EXPECT_THAT(told, HasSubstr("speed up to 5.98 against 3 rad/s"));
  EXPECT_THAT(told, Not(HasSubstr("travel")));
  EXPECT_EQ(goes_farther(fast, slow, {}), "") << "the fitted one covers the other";
  EXPECT_THAT(goes_farther(slow, fast, Coordinates::kTranslation), HasSubstr("3 m/s"));
}

TEST(GoesFarther, IsSilentWhereBothAreAlikeOrNeitherCoversTheOther) {
  const MotionReach usual = reach(swung(0.5, 6.0, 2.0));
  EXPECT_EQ(goes_farther(usual, reach(swung(0.55, 6.5, 2.1)), {}), "");
  EXPECT_EQ(goes_farther(usual, reach(swung(0.2, 30.0, 2.0)), {}), "") << "faster, but over half the travel";
}

TEST(GoesFarther, AnInputThatIsNotKnownDecidesNothing) {
  MotionReach unknown = reach(swung(0.5, 6.0, 2.0));
  unknown.input = 0.0;
  EXPECT_THAT(goes_farther(unknown, reach(swung(1.0, 6.0, 2.0)), {}), HasSubstr("travel 2 against 1 rad"));
}

/// An arm that was let go: the last three quarters fall without an input.
Recording dropped() {
  Recording r = swung(0.5, 12.0, 2.0);
  for (std::size_t i = 500; i < r.x1.size(); ++i)
    r.u[i] = 0.0, r.x1[i] = r.x1[499] + 3.0 * std::sin(20.0 * r.dt * static_cast<double>(i - 499));
  return r;
}

TEST(MotionReach, CountsNothingOfADriveThatWasSwitchedOff) {
  const MotionReach r = reach(dropped());
  EXPECT_NEAR(r.travel, 1.0, 1e-2);
  EXPECT_NEAR(r.speed, 6.0, 0.1);
  EXPECT_EQ(r.reversals, 4);
}

using Fit = FittingOrder::Fit;

TEST(FittingOrder, NeverPrefersARecordingThatMovesInOneDirectionOnly) {
  const MotionReach both_ways = reach(swung(0.5, 6.0, 2.0));
  MotionReach one_way = reach(swung(2.0, 12.0, 4.0));
  one_way.reversals = 0;
  EXPECT_EQ(fitting_order(both_ways, one_way, {}).fit, Fit::kFirst);
  EXPECT_EQ(fitting_order(both_ways, one_way, {}).why, "7 reversals against none");
  EXPECT_EQ(fitting_order(one_way, both_ways, {}).fit, Fit::kSecond);
  EXPECT_EQ(goes_farther(both_ways, one_way, {}), "");
}

TEST(FittingOrder, TakesTheOneThatGoesFartherWhicheverStandsFirst) {
  const MotionReach slow = reach(swung(0.5, 6.0, 2.0)), fast = reach(swung(0.5, 12.0, 2.0));
  EXPECT_EQ(fitting_order(slow, fast, {}).fit, Fit::kSecond);
  const FittingOrder order = fitting_order(fast, slow, {});
  EXPECT_EQ(order.fit, Fit::kFirst);
  EXPECT_THAT(order.why, HasSubstr("speed up to 5.98 against 3 rad/s, 15 reversals against 7"));
}

TEST(FittingOrder, AmongTwoThatGoAsFarCountsReversals) {
  const MotionReach usual = reach(swung(0.5, 6.0, 2.0));
  MotionReach busy = usual;
  busy.reversals = 30;
  const FittingOrder order = fitting_order(usual, busy, {});
  EXPECT_EQ(order.fit, Fit::kSecond);
  EXPECT_EQ(order.why, "30 reversals against 7");
  EXPECT_EQ(fitting_order(usual, usual, {}).fit, Fit::kEither);
}

TEST(FittingOrder, LeavesItOpenWhereNeitherCoversTheOther) {
  const MotionReach wide = reach(swung(0.5, 6.0, 2.0)), fast = reach(swung(0.2, 30.0, 2.0));
  const FittingOrder order = fitting_order(wide, fast, {});
  EXPECT_EQ(order.fit, Fit::kEither);
  EXPECT_THAT(order.why, HasSubstr("neither covers the other: speed up to 3 against 5.89 rad/s, travel 1"));
}

TEST(JudgesLittle, IsSaidOfARecordingThatGoesOneWayOrStands) {
  const MotionReach usual = reach(swung(0.5, 6.0, 2.0));
  EXPECT_EQ(judges_little(usual, usual), "");
  Recording rising = swung(0.5, 0.3, 2.0);  // less than a quarter of a turn of its phase
  EXPECT_THAT(judges_little(usual, reach(rising)),
              HasSubstr("moves in one direction only: nothing that depends"));
  EXPECT_EQ(judges_little(reach(rising), reach(rising)), "") << "nor was the other one fitted";
  Recording resting = swung(0.5, 6.0, 2.0);
  for (std::size_t i = 600; i < resting.x1.size(); ++i) resting.x1[i] = resting.x1[600];
  EXPECT_THAT(judges_little(usual, reach(resting)), HasSubstr("rests in 7"));
  Recording coarse = resting;  // a count that is more than a twentieth of the fastest way in 20 ms flickers
  for (std::size_t i = 0; i < coarse.x1.size(); ++i)
    coarse.x1[i] = 0.01 * std::round(coarse.x1[i] / 0.01) + (i >= 600 && i / 10 % 2 == 0 ? 0.01 : 0.0);
  EXPECT_THAT(judges_little(usual, reach(coarse)), HasSubstr("rests in 7"));
}

}  // namespace
}  // namespace gapscope
