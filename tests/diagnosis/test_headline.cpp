#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/headline.h"

namespace gapscope::internal::diagnosis {
namespace {

/// An error of which so much is in engagement, where the drive is most of the time.
std::string headline_with(double share, double expected) {
  MismatchPlace place;
  place.mode = {{"gap", 1.0 - share, 1.0 - expected}, {"engagement", share, expected}, {"impact", 0.0, 0.0}};
  place.phase = ContactPhase::kEngagement;
  return headline_of(place, {});
}

TEST(Headline, NamesAPhaseOfTheContactOnlyWhereTheErrorIsDenserThanChance) {
  EXPECT_EQ(headline_with(0.82, 0.8), "no clear pattern in angle, speed, input or time");
  EXPECT_EQ(headline_with(0.6, 0.8), "no clear pattern in angle, speed, input or time");
  EXPECT_TRUE(
      headline_with(0.98, 0.8).starts_with("in engagement (98 % of the squared correcting torque in 80 %"));
  EXPECT_TRUE(headline_with(0.4, 0.2).starts_with("in engagement"));
}

TEST(Headline, NamesImpactsAndWhatIsBehindThemWhereNothingElseOrdersTheError) {
  MismatchPlace place;
  place.mode = {{"gap", 0.2, 0.2}, {"engagement", 0.8, 0.8}, {"impact", 0.0, 0.0}};
  place.phase = ContactPhase::kEngagement;
  place.behind_impacts = {"", 0.91, 0.2};
  EXPECT_EQ(headline_of(place, {}),
            "at impacts and just behind them (91 % of the squared correcting torque in 20 % of the time)");
  place.behind_impacts = {"", 0.4, 0.1};
  EXPECT_THAT(headline_of(place, {}), ::testing::StartsWith("no clear pattern")) << "most is elsewhere";
  place.behind_impacts = {"", 0.91, 0.9};
  EXPECT_THAT(headline_of(place, {}), ::testing::StartsWith("no clear pattern")) << "they are everywhere";
  place.behind_impacts = {"", 0.91, 0.2}, place.follows = {ResidualPattern::kDirection};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_EQ(headline_of(place, {}), "reverses with the direction of motion");
}

TEST(Headline, SaysInWhichDirectionTheErrorIsOrThatItIsInBoth) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kDirection};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_EQ(headline_of(place, {}), "reverses with the direction of motion");
  place.direction = {{"backward", 0.9, 0.5}, {"forward", 0.1, 0.5}};
  EXPECT_EQ(headline_of(place, {}), "reverses with the direction of motion, 3 times as large backward (rms)");
  EXPECT_EQ(headline_of(place, {}, false),
            "depends on the direction of motion, 3 times as large backward (rms)");
  place.direction = {{"backward", 1.0, 0.5}, {"forward", 0.0, 0.5}};
  EXPECT_EQ(headline_of(place, {}, false), "depends on the direction of motion, all of it backward");
}

TEST(Headline, SaysNothingOfADirectionWithoutTheOther) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kDirection, ResidualPattern::kInput};
  place.input = {{"0..1 N m", 0.2, 0.5}, {"1..2 N m", 0.8, 0.5}};
  place.direction = {{"backward", 0.0, 0.0}, {"forward", 1.0, 1.0}};
  EXPECT_EQ(headline_of(place, {}),
            "depends on the input level (largest at 1–2 N·m); only forward motion was recorded");
  place.direction = {{"backward", 0.26, 0.04}, {"forward", 0.74, 0.96}};
  EXPECT_EQ(headline_of(place, {}),
            "depends on the input level (largest at 1–2 N·m); hardly any backward motion was recorded");
  place.follows = {ResidualPattern::kDirection};
  EXPECT_EQ(headline_of(place, {}),
            "no place that these recordings tell; hardly any backward motion was recorded");
  place.direction = {{"backward", 0.26, 0.11}, {"forward", 0.74, 0.89}};
  EXPECT_EQ(headline_of(place, {}),
            "reverses with the direction of motion, 1.7 times as large backward (rms)");
}

TEST(Headline, LeavesTheTimeToWhatNoEffectExplains) {
  const std::vector<PatternStrength> patterns = {{ResidualPattern::kSpeed, 0.2},
                                                 {ResidualPattern::kTime, 0.9}};
  EXPECT_EQ(followed_patterns(patterns, nullptr), std::vector{ResidualPattern::kTime});
  const ModelEffect cogging{find_effect("cogging_torque"), {}};
  EXPECT_EQ(followed_patterns(patterns, &cogging), std::vector{ResidualPattern::kAngle});
}

TEST(Headline, CallsOneCycleOncePerTurn) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kAngle};
  place.periods_per_turn = 1.0;
  EXPECT_EQ(headline_of(place, {}), "periodic in the motor angle, once per turn");
  place.periods_per_turn = 24.0;
  EXPECT_EQ(headline_of(place, {}), "periodic in the motor angle with 24 cycles per turn");
  place.follows = {ResidualPattern::kDirection, ResidualPattern::kAngle};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_EQ(
      headline_of(place, {}),
      "reverses with the direction of motion and is periodic in the motor angle with 24 cycles per turn");
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
