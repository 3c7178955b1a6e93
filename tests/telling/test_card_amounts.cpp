// What the card says of the amounts of what helps.
#include <gmock/gmock.h>

#include "support/told.h"
#include "telling/slide_card.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::slide_diagnosis;

TEST(Card, TellsTheAmountOfWhatHelps) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  d.added[1].parameters = {{"share", "-", 0.2}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.mismatch.before = 1.28e-3, d.mismatch.after = 1.42e-3,
  d.mismatch.measure = "free run restarted every 2 s";
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.added[1].effect = "friction_asymmetry", d.added[1].parameters = {{"level_nm", "N m", 20.54}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps) << "both share one amount";
}

// In a model with two effects that contain friction each has a part of its level.
TEST(Card, TellsTheWholeLevelOfFrictionThatTwoEffectsShareAndARatioOfAllOfIt) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters.clear();
  d.added[1].effect = "friction_asymmetry";
  d.added[1].parameters = {{"level_nm", "N m", 15.0}, {"coulomb_ratio", "-", 0.2, {0.1, 0.3}}};
  d.added.push_back(d.added[1]);
  d.added[2].effect = "stribeck_friction";
  d.added[2].parameters = {{"level_nm", "N m", 5.0, {4.0, 6.0}}, {"stiction_ratio", "-", -0.8, {-0.9, -0.7}}};
  const std::string helps = card_of(facts_of(nullptr, &d)).helps;
  EXPECT_TOLD(helps);
}

TEST(Card, TellsWhereASteadyTorquePushes) {
  Diagnosis d = slide_diagnosis();
  d.added[1].effect = "constant_load_torque";
  d.added[1].parameters = {{"torque_nm", "N m", -2.2726, {-2.2807, -2.2644}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.added[1].parameters = {{"torque_nm", "N m", 2.2726}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

TEST(Card, TellsAnAmountWithoutAUnitAsAShareAndALawByWhatItAddsToASimplerOne) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  d.added[1].effect = "torque_ripple", d.added[1].parameters = {{"ratio", "-", 0.0312, {0.0305, 0.0319}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.added[1].effect = "load_dependent_friction";
  d.added[1].parameters = {{"level_nm", "N m", 20.54}, {"ratio", "-", 0.1, {0.09, 0.11}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

TEST(Card, OfALawWithSeveralRatiosTellsTheLargest) {
  Diagnosis d = slide_diagnosis();
  d.added[1].effect = "friction_asymmetry";
  d.added[1].parameters = {{"level_nm", "N m", 20.54},
                           {"coulomb_ratio", "-", -0.0052},
                           {"viscous_ratio", "-", -0.2, {-0.22, -0.18}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

TEST(Card, OfOneEffectTellsTheAmountAndOfSeveralTheShares) {
  Diagnosis d = slide_diagnosis();
  d.added.erase(d.added.begin());
  d.added.front().established = true;
  d.added.front().parameters = {{"amplitude_nm", "N m", 2.054}, {"periods_per_turn", "1/rev", 2513.3}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.added.front().parameters.clear();
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d = slide_diagnosis();
  d.added[0].after_torque = kNaN, d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

/// Between the lines of a budget there may be laws that the model cannot have, and effects beside them.
TEST(Card, TellsTheTorqueOfTheModelThatFittedYamlHas) {
  Diagnosis d = slide_diagnosis();
  d.budget.band_hz = 8.0;
  d.mismatch.after_torque = 3.0;  // the last line, 2.0, has a law beside both that nobody can add
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  const std::string counted = card_of(facts_of(nullptr, &d)).helps;
  d.budget.uncounted = {"cogging_torque"};  // then the observer has measured both sizes
  EXPECT_EQ(card_of(facts_of(nullptr, &d)).helps, counted);
}

TEST(Card, TellsAnAmountWithItsInterval) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54, {20.1, 20.98}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.added.pop_back();
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

TEST(Card, OfManyEffectsTellsWhatEachLeaves) {
  Diagnosis d = slide_diagnosis();
  d.added.resize(1);
  for (const char* more : {"cogging_torque", "viscous_friction", "torque_ripple", "load_friction"})
    d.added.push_back({more, true, {more}, kNaN, {}, 0.1, {}, 4.0 - 0.5 * double(d.added.size())});
  Card card = card_of(facts_of(nullptr, &d));
  EXPECT_TOLD(card.helps);
  EXPECT_TOLD(card.cause);
}

TEST(Card, TellsLinesOfOneEffectApartByTheirPeriods) {
  Diagnosis d = slide_diagnosis();
  d.effects = {"cogging_torque", "cogging_torque"};
  for (AddedEffect& a : d.added)
    a.effect = "cogging_torque", a.established = true, a.group = {"cogging_torque"};
  d.added[0].parameters = {{"amplitude_nm", "N m", 5.0}, {"periods_per_turn", "1/rev", 2.0 * kPi / 2.5e-3}};
  d.added[1].parameters = {{"amplitude_nm", "N m", 1.0}, {"periods_per_turn", "1/rev", 2.0 * kPi / 0.01}};
  CardFacts f = facts_of(nullptr, &d);
  EXPECT_TOLD(card_of(f).cause);
  EXPECT_TOLD(card_of(f).helps);
  f.coordinates = Coordinates::kRotation;
  d.added[0].parameters[1].value = 24.0, d.added[1].parameters[1].value = 7.25;
  EXPECT_TOLD(card_of(f).cause);
}

TEST(CardNext, NamesAFormatThatHasAllThatWasAddedOrSaysThatNoneHas) {
  Diagnosis d = slide_diagnosis();
  for (AddedEffect& a : d.added) a.established = true;
  CardFacts f = facts_of(nullptr, &d);
  EXPECT_TOLD(card_of(f).next);
  f.carriers = {"c"};
  EXPECT_TOLD(card_of(f).next);
  d.closed_loop = ClosedLoop{0.4, 0.05, {}};
  EXPECT_TOLD(card_of(f).next);
  d.closed_loop.reset();
  f.carriers = std::vector<std::string>(), f.uncarried = {"load_dependent_friction"};
  EXPECT_TOLD(card_of(f).next);
}

}  // namespace
}  // namespace gapscope
