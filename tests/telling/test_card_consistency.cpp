// That no two lines of a card, nor a card and the answer beside it, say different things of one quantity.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "diagnosis/verdict.h"
#include "support/told.h"
#include "telling/answer.h"
#include "telling/slide_card.h"

namespace gapscope {
namespace {

using internal::diagnosis::open_undetermined;
using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::slide_diagnosis;
using ::testing::StartsWith;

/// Explained to the floor by a delay that the torque balance has no place for, while the observer's
/// correcting torque, which is noise, hardly falls.
Diagnosis of_uncounted() {
  Diagnosis d = of_friction_and_delay(true, true);
  d.effects.pop_back(), d.added.pop_back();
  d.added.front().group.resize(1);
  d.mismatch.before = 16.1e-3, d.mismatch.after = 0.17e-3, d.mismatch.floor = 0.136e-3;
  d.mismatch.remains = 1.25, d.mismatch.measure = "free run restarted every 0.5 s";
  d.mismatch.before_torque = 0.328, d.mismatch.after_torque = 0.311, d.mismatch.input_torque = 2.32;
  d.mismatch.shrink_ci95 = {0.9, 1.0};
  d.budget.band_hz = 16.0, d.budget.input = 2.33, d.budget.nominal = 0.201, d.budget.encoder = 0.02;
  d.budget.uncounted = {"motor_coulomb_friction"};
  return d;
}

TEST(CardConsistency, WhatHardlyTakesTorqueIsToldByTheMotionThatItMoves) {
  Diagnosis d = slide_diagnosis();
  d.mismatch.after_torque = 9.99, d.mismatch.after = d.mismatch.floor;
  EXPECT_FALSE(is_told_in_torque(d));
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).helps);
  d.mismatch.after_torque = 8.0;
  EXPECT_FALSE(is_told_in_torque(d)) << "most of it is the noise of the encoder";
  d.mismatch.after_torque = 0.4 * d.mismatch.before_torque;
  EXPECT_TRUE(is_told_in_torque(d));
  d.mismatch.after_torque = 9.99, d.mismatch.after = d.mismatch.before;  // neither falls
  EXPECT_TRUE(is_told_in_torque(d));
}

TEST(CardConsistency, WhereTheTorqueDoesNotFallAsTheMotionDoesTheBalanceTellsTheSizeAndTheMotionWhatHelps) {
  Diagnosis d = of_uncounted();
  const Card card = card_of(d);
  EXPECT_TOLD(card.brief.mismatch);
  EXPECT_TOLD(card.helps);
  EXPECT_EQ(card.torque, 0.201);
  EXPECT_TRUE(std::isnan(card.torque_after));
  d.mismatch.after_torque = 0.02;
  EXPECT_TOLD(card_of(d).helps) << "it falls as far";
  d.mismatch.after_torque = 0.15, d.budget.uncounted.clear();
  EXPECT_TOLD(card_of(d).helps) << "of the balance";
}

TEST(CardConsistency, AToleranceOfTheTorqueIsThenJudgedByTheBalance) {
  const Diagnosis d = of_uncounted();
  CardFacts f;
  f.diagnosis = &d, f.tolerance.torque_percent = 5.0;
  EXPECT_TOLD(gapscope::card_of(f).mismatch);
  f.tolerance.torque_percent = 10.0;
  EXPECT_TOLD(gapscope::card_of(f).mismatch);
}

/// A gap that the diagnosis has fitted, of 20 mrad, to the floor.
Diagnosis of_gap() {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = d.mismatch.after = 7e-6, d.mismatch.floor = 8e-6;
  d.model_gap = ModelGap{GapOrigin::kEstimated, 20e-3, {19.9e-3, 20.1e-3}};
  return d;
}

TEST(CardConsistency, TheGapOfTheDiagnosisGoesBeforeThatOfAnEstimateWhoseFitIsRejected) {
  const Diagnosis d = of_gap();
  Answer reading{20.3e-3, {19.3e-3, 21.3e-3}, AnswerSource::kModelFree, AnswerTrust::kGood, "", {}};
  FitSummary fit;
  fit.trust = FitTrust::kRejected;
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kBacklash;
  Findings beside;
  beside.model_free = &estimate, beside.reference = &fit;
  std::optional<Answer> told = answer_of_diagnosis(d, reading, beside);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->trust, AnswerTrust::kGood);
  EXPECT_EQ(told->gap, 20e-3);
  EXPECT_TOLD(told->sentence);
  reading.ci95 = {20.2e-3, 20.4e-3};
  told = answer_of_diagnosis(d, reading, beside);
  EXPECT_EQ(told->trust, AnswerTrust::kLimited);
  EXPECT_TOLD(told->sentence);
  fit.trust = FitTrust::kGood;
  EXPECT_FALSE(answer_of_diagnosis(d, reading, beside).has_value()) << "the estimate has a fit of its own";
}

TEST(CardConsistency, TheGapOfTheDiagnosisGoesBeforeThatOfAModelWhichLackedWhatItFound) {
  Diagnosis d = of_gap();
  const Answer fitted{18e-3, {17e-3, 19e-3}, AnswerSource::kReference, AnswerTrust::kLimited, "It is.", {}};
  FitSummary fit;
  fit.trust = FitTrust::kLimited;
  Findings beside;
  beside.reference = &fit;
  d.verdict = DiagnosisVerdict::kEffect;
  std::optional<Answer> told = answer_of_diagnosis(d, fitted, beside);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->gap, 20e-3);
  d.verdict = DiagnosisVerdict::kUnknown;
  EXPECT_FALSE(answer_of_diagnosis(d, fitted, beside).has_value()) << "it found nothing";
}

TEST(CardConsistency, AGapThatNobodyTellsIsReadAgainWithWhatWasFound) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 10.0, d.exhausted = true;
  d.model_gap = {GapOrigin::kEstimated, 0.0136, {0.0135, 0.0137}};
  EXPECT_TOLD(card_of(d).next);
  const Answer told{0.0136, {0.0135, 0.0137}, AnswerSource::kDiagnosis, AnswerTrust::kLimited, "It is.", {}};
  CardFacts f;
  f.diagnosis = &d, f.answer = &told;
  EXPECT_TOLD(gapscope::card_of(f).next);
}

TEST(CardConsistency, AGapThatDividesOneBodyIsToldWhereItExplainsAllAndElseAskedForInTheModel) {
  Diagnosis d = of_friction_and_delay(false, true);
  d.added.emplace_back();
  d.added.back().effect = "backlash";
  d.model_gap = {GapOrigin::kEstimated, 0.0328, {0.0309, 0.0348}};
  d.mismatch.after = 6.5e-4, d.mismatch.floor = 3.2e-6;
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates::kRotation).has_value()) << "2 % of 32.8 mrad; it was 16.8";
  EXPECT_TOLD(card_of(d).next);
  d.added.back().effect = "cogging_torque";
  EXPECT_TRUE(answer_of_diagnosis(d, Coordinates::kRotation).has_value()) << "of the model's own gap";
  d.added.back().effect = "backlash";
  d.mismatch.after = 3.3e-6;
  EXPECT_EQ(answer_of_diagnosis(d, Coordinates::kRotation)->trust, AnswerTrust::kGood);
}

TEST(CardConsistency, AGapThatIsLeftOpenByAPartOfItIsNotTrustedWell) {
  Diagnosis d = of_gap();
  ASSERT_EQ(answer_of_diagnosis(d, Coordinates::kRotation)->trust, AnswerTrust::kGood);
  d.model_gap->ci95 = {17e-3, 23e-3};
  const std::optional<Answer> told = answer_of_diagnosis(d, Coordinates::kRotation);
  EXPECT_EQ(told->trust, AnswerTrust::kLimited);
  CardFacts f;
  f.diagnosis = &d, f.answer = &*told;
  EXPECT_TOLD(gapscope::card_of(f).gap);
}

TEST(CardConsistency, AGapThatIsDeniedAndFittedIsADisagreement) {
  Diagnosis d = of_gap();
  Answer denial{kNaN, {}, AnswerSource::kModelFree, AnswerTrust::kLimited, "There is no backlash above", {}};
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kNone;
  estimate.smallest_visible_gap = 16e-3;
  Findings beside;
  beside.model_free = &estimate;
  std::optional<Answer> told = answer_of_diagnosis(d, denial, beside);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->trust, AnswerTrust::kLimited);
  EXPECT_TOLD(told->sentence);
  d.mismatch.after = 1e-3, d.verdict = DiagnosisVerdict::kHelps;  // which does not follow the recordings
  told = answer_of_diagnosis(d, denial, beside);
  ASSERT_TRUE(told.has_value());
  EXPECT_TRUE(std::isnan(told->gap));
  EXPECT_TOLD(told->sentence);
  estimate.smallest_visible_gap = 30e-3;
  EXPECT_FALSE(answer_of_diagnosis(d, denial, beside).has_value()) << "both may be so";
  d = of_gap();
  told = answer_of_diagnosis(d, denial, beside);
  EXPECT_EQ(told->trust, AnswerTrust::kGood);
  EXPECT_TOLD(told->sentence);
}

TEST(CardConsistency, LimitedTrustInADenialHasItsReason) {
  Answer denial{kNaN, {}, AnswerSource::kModelFree, AnswerTrust::kLimited, "", {}};
  go_on(denial, {{"none.model_free", {number("least", 1e-3, "rad"), per_cent("share", kNaN)}}}, {});
  CardFacts f;
  f.answer = &denial;
  EXPECT_TOLD(gapscope::card_of(f).gap);
  EXPECT_THAT(gapscope::card_of(f).codes.gap, ::testing::Contains("trust.limited.light_load"));
  denial.trust = AnswerTrust::kGood;
  EXPECT_TOLD(gapscope::card_of(f).gap);
}

TEST(CardConsistency, NoStepUsesAModelForWhatItDoesWorse) {
  Diagnosis d = of_friction_and_delay(true, false);
  EXPECT_TOLD(card_of(d).next);
  d.whole_run = WholeRun{0.147, 1.45, 3.24};
  EXPECT_TOLD(card_of(d).next);
  d.whole_run->after = 0.3;
  EXPECT_TOLD(card_of(d).next);
  d.mismatch.after = d.mismatch.before;
  EXPECT_TOLD(card_of(d).next);
}

/// One cogging torque of N cycles per turn, over a motion of 2 rad.
Diagnosis of_period(double periods_per_turn) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.effects = {"cogging_torque"};
  d.added.resize(1);
  AddedEffect& a = d.added.front();
  a.effect = "cogging_torque", a.group = {a.effect};
  a.parameters = {{"amplitude_nm", "N m", 0.1, {0.09, 0.11}},
                  {"periods_per_turn", "1/rev", periods_per_turn}};
  d.traces.resize(1);
  d.traces.front().x1 = {50.0, 0.0, 2.0}, d.traces.front().scored_from = 1;
  open_undetermined(d);
  return d;
}

TEST(CardConsistency, APeriodThatTheHeldOutMotionDoesNotGoThroughIsNoCause) {
  const Diagnosis within = of_period(3.2), beyond = of_period(3.1);  // 1.96 and 2.03 rad
  EXPECT_TRUE(within.added.front().established);
  EXPECT_FALSE(beyond.added.front().established);
  EXPECT_EQ(beyond.verdict, DiagnosisVerdict::kHelps);
  EXPECT_TOLD(card_of(beyond).cause);
  Diagnosis given = of_period(3.2);
  given.periodic.push_back({3.0, kNaN, kNaN, kNaN, kNaN, 0, 0, false, true});
  given.added.front().parameters[1].value = 3.0;
  open_undetermined(given);
  EXPECT_TRUE(given.added.front().established) << "somebody knows of it";
  given.added.front().effect = "load_unbalance", given.periodic.clear();
  open_undetermined(given);
  EXPECT_TRUE(given.added.front().established) << "its period is one turn, whatever the motion";
}

}  // namespace
}  // namespace gapscope
