#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/told.h"
#include "telling/headline.h"

namespace gapscope::internal::telling {
namespace {

/// An error of which so much is in engagement, where the drive is most of the time.
std::string headline_with(double share, double expected) {
  MismatchPlace place;
  place.mode = {{"gap", 1.0 - share, 1.0 - expected}, {"engagement", share, expected}, {"impact", 0.0, 0.0}};
  place.phase = ContactPhase::kEngagement;
  return headline_of(place, {});
}

TEST(Headline, NamesAPhaseOfTheContactOnlyWhereTheErrorIsDenserThanChance) {
  EXPECT_TOLD(headline_with(0.82, 0.8));
  EXPECT_TOLD(headline_with(0.6, 0.8));
  EXPECT_TOLD(headline_with(0.98, 0.8));
  EXPECT_TOLD(headline_with(0.4, 0.2));
}

TEST(Headline, NamesImpactsAndWhatIsBehindThemWhereNothingElseOrdersTheError) {
  MismatchPlace place;
  place.mode = {{"gap", 0.2, 0.2}, {"engagement", 0.8, 0.8}, {"impact", 0.0, 0.0}};
  place.phase = ContactPhase::kEngagement;
  place.behind_impacts = {"", 0.91, 0.2};
  EXPECT_TOLD(headline_of(place, {}));
  place.behind_impacts = {"", 0.4, 0.1};
  EXPECT_TOLD(headline_of(place, {})) << "most is elsewhere";
  place.behind_impacts = {"", 0.91, 0.9};
  EXPECT_TOLD(headline_of(place, {})) << "they are everywhere";
  place.behind_impacts = {"", 0.91, 0.2}, place.follows = {ResidualPattern::kDirection};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_TOLD(headline_of(place, {}));
}

TEST(Headline, SaysInWhichDirectionTheErrorIsOrThatItIsInBoth) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kDirection};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_TOLD(headline_of(place, {}));
  place.direction = {{"backward", 0.9, 0.5}, {"forward", 0.1, 0.5}};
  EXPECT_TOLD(headline_of(place, {}));
  place.reverses = false;
  EXPECT_TOLD(headline_of(place, {}));
  place.direction = {{"backward", 1.0, 0.5}, {"forward", 0.0, 0.5}};
  EXPECT_TOLD(headline_of(place, {}));
}

TEST(Headline, SaysNothingOfADirectionWithoutTheOther) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kDirection, ResidualPattern::kInput};
  place.input = {{"0..1 N m", 0.2, 0.5}, {"1..2 N m", 0.8, 0.5}};
  place.direction = {{"backward", 0.0, 0.0}, {"forward", 1.0, 1.0}};
  EXPECT_TOLD(headline_of(place, {}));
  place.direction = {{"backward", 0.26, 0.04}, {"forward", 0.74, 0.96}};
  EXPECT_TOLD(headline_of(place, {}));
  place.follows = {ResidualPattern::kDirection};
  EXPECT_TOLD(headline_of(place, {}));
  place.direction = {{"backward", 0.26, 0.11}, {"forward", 0.74, 0.89}};
  EXPECT_TOLD(headline_of(place, {}));
}

TEST(Headline, CallsOneCycleOncePerTurn) {
  MismatchPlace place;
  place.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  place.follows = {ResidualPattern::kAngle};
  place.periods_per_turn = 1.0;
  EXPECT_TOLD(headline_of(place, {}));
  place.periods_per_turn = 24.0;
  EXPECT_TOLD(headline_of(place, {}));
  place.follows = {ResidualPattern::kDirection, ResidualPattern::kAngle};
  place.direction = {{"backward", 0.5, 0.5}, {"forward", 0.5, 0.5}};
  EXPECT_TOLD(headline_of(place, {}));
}

}  // namespace
}  // namespace gapscope::internal::telling
