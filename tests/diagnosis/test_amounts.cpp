// What the study of amounts counts: intervals against what was drawn.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/amount_study.h"

namespace gapscope {
namespace {

const std::vector<blind::DrawnLaw> kDrawn = {{"load_unbalance",
                                              blind::LawForm::kSame,
                                              {{"amplitude_nm", "N m", 0.03, {}},
                                               {"phase_rad", "rad", 6.0, {}},
                                               {"periods_per_turn", "1/rev", 1.0, {}}}}};

Diagnosis told(bool is_established) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kEffect;
  AddedEffect a;
  a.effect = "load_unbalance";
  a.established = is_established;
  a.parameters = {{"amplitude_nm", "N m", 0.0315, {0.0285, 0.0345}},
                  {"phase_rad", "rad", 6.0 - 2.0 * kPi, {5.9 - 2.0 * kPi, 6.1 - 2.0 * kPi}},
                  {"periods_per_turn", "1/rev", 1.0, {}}};
  d.added = {a};
  return d;
}

test::StudyRow row_of(const Diagnosis& d) {
  test::StudyRow row;
  row.effect = "load_unbalance";
  row.details = "[load_unbalance] leaves 1;" + test::told_numbers_in_words(kDrawn, d);
  return row;
}

TEST(ToldNumbers, AreReadBackAsTheyWereTold) {
  const auto numbers = test::told_numbers(row_of(told(true)));
  ASSERT_EQ(numbers.size(), 3U);
  EXPECT_EQ(numbers[0].key, "amplitude_nm");
  EXPECT_DOUBLE_EQ(numbers[0].drawn, 0.03);
  EXPECT_DOUBLE_EQ(numbers[0].told, 0.0315);
  EXPECT_DOUBLE_EQ(numbers[0].ci95.low, 0.0285);
  EXPECT_DOUBLE_EQ(numbers[0].ci95.high, 0.0345);
}

TEST(ToldNumbers, HoldWhatLiesWithinTheIntervalAndAPhaseWithinAnyTurn) {
  auto numbers = test::told_numbers(row_of(told(true)));
  ASSERT_EQ(numbers.size(), 3U);
  EXPECT_TRUE(numbers[0].holds());
  EXPECT_NEAR(numbers[0].deviation(), 1.96 / 2.0, 1e-6);  // half of the half width
  EXPECT_TRUE(numbers[1].holds());
  EXPECT_NEAR(numbers[1].deviation(), 0.0, 1e-6);
  EXPECT_FALSE(numbers[2].has_interval());
  EXPECT_FALSE(numbers[2].holds());
  numbers[0].drawn = 0.028;
  EXPECT_FALSE(numbers[0].holds());
}

TEST(ToldNumbers, AreOnlyThoseOfAnEstablishedEffect) {
  EXPECT_TRUE(test::told_numbers(row_of(told(false))).empty());
  Diagnosis other = told(true);
  other.added.front().effect = "constant_load_torque";
  EXPECT_TRUE(test::told_numbers(row_of(other)).empty());
}

TEST(AmountCounts, AddUpWhatHoldsAndHowFarOffItIs) {
  test::AmountCount c;
  test::ToldNumber n{"level_nm", 1.0, 1.0, {0.9, 1.1}};
  c.add(n);
  n.drawn = 0.8;  // twice the half width off
  c.add(n);
  EXPECT_EQ(c.held, 1);
  EXPECT_EQ(c.all, 2);
  EXPECT_NEAR(c.squares, std::pow(2.0 * 1.96, 2), 1e-9);
}

}  // namespace
}  // namespace gapscope
