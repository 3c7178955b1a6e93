#include <gtest/gtest.h>

#include "blind/expected_place.h"

namespace gapscope {
namespace {

using blind::names_the_place;

ToldPlace told(const char* phase, std::vector<std::string> follows, double cycles = kNaN) {
  return {phase, std::move(follows), cycles};
}

TEST(ExpectedPlace, OfAPatternIsToldByThatPattern) {
  EXPECT_TRUE(names_the_place(told("gap", {"direction"}), "stribeck_friction", kNaN));
  EXPECT_TRUE(names_the_place(told("", {"speed", "time"}), "viscous_drift", kNaN));
  EXPECT_FALSE(names_the_place(told("engagement", {"speed"}), "input_dead_zone", kNaN));
  EXPECT_FALSE(names_the_place(told("engagement", {}), "quadratic_drag", kNaN));
}

TEST(ExpectedPlace, OfACycleNeedsItsPeriodToo) {
  EXPECT_TRUE(names_the_place(told("", {"angle"}, 24.5), "cogging_torque", 24.0));
  EXPECT_FALSE(names_the_place(told("", {"angle"}, 12.0), "cogging_torque", 24.0));
  EXPECT_FALSE(names_the_place(told("", {"angle"}, kNaN), "load_unbalance", 1.0));
}

TEST(ExpectedPlace, OfAContactIsThePhaseThatShowsIt) {
  EXPECT_TRUE(names_the_place(told("impact", {"time"}), "impact_damping", kNaN));
  EXPECT_FALSE(names_the_place(told("gap", {}), "shaft_compliance", kNaN));
  EXPECT_TRUE(names_the_place(told("gap", {}), "contact_adhesion", kNaN));
  EXPECT_FALSE(names_the_place(told("", {}), "constant_load_torque", kNaN));
}

TEST(ExpectedPlace, OfWhatTheCatalogueLacksIsNowhere) {
  EXPECT_FALSE(names_the_place(told("gap", {"direction"}), "belt_slip", kNaN));
}

TEST(ExpectedPlace, IsToldAsTheDiagnosisHasIt) {
  MismatchPlace place;
  place.phase = ContactPhase::kEngagement;
  place.follows = {ResidualPattern::kAngle, ResidualPattern::kInputSteps};
  place.periods_per_turn = 6.0;
  const ToldPlace t = blind::told_place(place);
  EXPECT_EQ(t.phase, "engagement");
  EXPECT_EQ(t.follows, (std::vector<std::string>{"angle", "input_steps"}));
  EXPECT_EQ(t.periods_per_turn, 6.0);
}

}  // namespace
}  // namespace gapscope
