// What the figures of a card are of: which evidence has decided, in which band, of which model.
#include <gmock/gmock.h>

#include "base/decimals.h"
#include "base/percents.h"
#include "base/shared_unit.h"
#include "support/told.h"
#include "telling/slide_card.h"

namespace gapscope {
namespace {

using testing::facts_of;
using ::testing::HasSubstr;
using testing::slide_diagnosis;
using ::testing::StartsWith;

std::string sentence_of(Diagnosis d) {
  put_into_words(d, Coordinates());
  return d.sentence;
}

/// As the torque balance has decided, with a free run that may not bear it out.
Diagnosis by_balance(double shrink, const Interval& ci95) {
  Diagnosis d = slide_diagnosis();
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kTorque;
  d.mismatch.shrink = shrink, d.mismatch.shrink_ci95 = ci95;
  d.mismatch.measure = "free run restarted every 0.5 s, median over windows of the rms";
  return d;
}

TEST(CardBasis, WhatRoundsToZeroHasNoSign) {
  EXPECT_EQ(with_decimals(-0.004, 2), "0.00");
  EXPECT_EQ(with_decimals(-0.0, 0), "0");
  EXPECT_EQ(with_decimals(-0.006, 2), "-0.01");
  EXPECT_EQ(SharedUnit(1.0, "%").with_interval(35.0, {-0.2, 70.2}), "35 %, 95 %: 0 to 70");
  EXPECT_EQ(SharedUnit(1.0, "N").number(-0.0), "0");
  const double both[] = {-0.2, 64.0};
  EXPECT_EQ(Percents(both)(-0.0001), "0.00 %");
}

TEST(CardBasis, ACauseThatTheNextExperimentIsToTellFromAnotherIsLikely) {
  Diagnosis d = slide_diagnosis();
  d.added.resize(1), d.effects.resize(1);
  d.mismatch.shrink_ci95 = {0.9, 1.0};
  EXPECT_TOLD(verdict_words(d, Coordinates()));
  TriedInput best;
  best.separations = {{"motor_coulomb_friction", "stribeck_friction", 0.2},
                      {"stribeck_friction", "motor_coulomb_friction", 0.1}};
  d.next_experiment.tried = {best};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).cause);
  EXPECT_TOLD(verdict_words(d, Coordinates()));
  EXPECT_TOLD(sentence_of(d));
  d.added.front().group.push_back("stribeck_friction");  // then it is told as one of two
  EXPECT_EQ(rival_of_first(d), "");
}

TEST(CardBasis, ACauseThatTheFreeRunCannotTellIsSaidToBeOfTheBalanceAlone) {
  const Diagnosis d = by_balance(0.46, {-2.57, 0.83});
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).cause);
  EXPECT_TOLD(sentence_of(d));
  const Diagnosis shown = by_balance(0.9, {0.59, 1.0});
  EXPECT_TOLD(card_of(facts_of(nullptr, &shown)).cause);
  const Diagnosis at_floor = by_balance(kNaN, {});
  EXPECT_TOLD(card_of(facts_of(nullptr, &at_floor)).cause);
  EXPECT_TOLD(sentence_of(at_floor));
  Diagnosis of_a_group = d;
  of_a_group.added.resize(1), of_a_group.added[0].group = {"motor_coulomb_friction", "quadratic_drag"};
  EXPECT_TOLD(card_of(facts_of(nullptr, &of_a_group)).cause);
  Diagnosis by_motion = d;
  for (AddedEffect& a : by_motion.added) a.share_of = ShareOf::kMotion;
  EXPECT_TOLD(card_of(facts_of(nullptr, &by_motion)).cause);
  EXPECT_TOLD(sentence_of(by_motion));
}

/// Of the balance a share is a fall of torque, as its table has it; of the motion one of its error.
TEST(CardBasis, AShareSaysWhatItIsOf) {
  Diagnosis d = by_balance(0.9, {0.6, 1.0});
  d.budget.band_hz = 8.0;
  d.budget.rungs.resize(2);
  d.budget.rungs[0].effect = d.effects[0], d.budget.rungs[0].before = 10.0, d.budget.rungs[0].after = 4.0;
  d.budget.rungs[1].effect = d.effects[1], d.budget.rungs[1].before = 4.0, d.budget.rungs[1].after = 2.0;
  d.mismatch.after_torque = 3.0;  // the fitted model is another one than that of the last line
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  Diagnosis behind = d;  // a law between them that is not in the model
  BudgetRung resonance;
  resonance.law = "resonance", resonance.effect = "shaft_compliance";
  behind.budget.rungs.insert(behind.budget.rungs.begin() + 1, resonance);
  behind.budget.rungs[1].after = 3.5;
  EXPECT_EQ(card_of(facts_of(nullptr, &behind)).helps, card_of(facts_of(nullptr, &d)).helps);
  behind.added.insert(behind.added.begin() + 1, behind.added[1]);
  EXPECT_TOLD(card_of(facts_of(nullptr, &behind)).helps);
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kMotion;
  d.mismatch.measure = "prediction of an observer at 3 Hz, median over windows of the rms";
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.laws.push_back({});
  d.laws.front().variable = "speed", d.laws.front().shrink = -0.001;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
}

TEST(CardBasis, TheLineOfThePlaceIsASentence) {
  Diagnosis d = slide_diagnosis();
  const auto where = [&](const std::string& headline) {
    d.where.headline = headline;
    return card_of(facts_of(nullptr, &d)).place;
  };
  EXPECT_TOLD(where("is periodic in the motor position, every 5 mm"));
  EXPECT_TOLD(where("depends on the speed (largest at 34–51 mm/s)"));
  EXPECT_TOLD(where("has no clear pattern in angle, speed, input or time"));
}

}  // namespace
}  // namespace gapscope
