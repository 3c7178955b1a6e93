#include <gmock/gmock.h>

#include "diagnosis/simulator.h"
#include "support/told.h"
#include "telling/slide_card.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::sharp_answer;
using testing::slide_diagnosis;
using ::testing::StartsWith;

TEST(Card, SaysHowToGetWhatWasNotAskedFor) {
  const Answer answer = sharp_answer();
  const Card card = card_of(facts_of(&answer, nullptr));
  EXPECT_THAT(card.codes.gap, ::testing::Contains("trust.good"));
  EXPECT_TOLD(card.mismatch);
  for (const std::string& line : {card.place, card.cause, card.helps, card.next}) EXPECT_TOLD(line);
  EXPECT_TRUE(std::isnan(card.torque));
  EXPECT_FALSE(card.diagnosed);
  Diagnosis d = slide_diagnosis();
  EXPECT_TRUE(card_of(facts_of(nullptr, &d)).diagnosed);
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
  d.model_gap = ModelGap();
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
  d.model_gap = ModelGap{GapOrigin::kGiven, 0.02, {}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
  d.model_gap = ModelGap{GapOrigin::kEstimated, 0.02, {0.018, 0.022}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
  d.mismatch.remains = 697.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
  d.mismatch.remains = 2.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).gap);
}

TEST(Card, TellsTheGapOfADiagnosisWhoseModelFollows) {
  Diagnosis d = slide_diagnosis();
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value()) << "it knows of none";
  d.model_gap = ModelGap{GapOrigin::kEstimated, 0.02, {0.018, 0.022}};
  d.mismatch.after = 1.2e-4;
  const std::optional<Answer> good = answer_of_diagnosis(d, Coordinates());
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(good->trust, AnswerTrust::kGood);
  EXPECT_EQ(good->from, AnswerSource::kDiagnosis);
  EXPECT_TOLD(good->sentence);
  d.mismatch.after = 5e-4;
  EXPECT_EQ(answer_of_diagnosis(d, Coordinates())->trust, AnswerTrust::kLimited);
  d.mismatch.after = 2e-3, d.model_gap->ci95 = {0.0185, 0.0215};
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value()) << "it is 20 floors off";
  d.model_gap->ci95 = {0.015, 0.025};
  EXPECT_EQ(answer_of_diagnosis(d, Coordinates())->trust, AnswerTrust::kLimited) << "as the interval says";
  d.model_gap->value = 0.25, d.model_gap->ci95 = {0.249, 0.251};
  EXPECT_EQ(answer_of_diagnosis(d, Coordinates())->trust, AnswerTrust::kLimited) << "0.8 % of the gap";
  d.stopped = true;
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value());
  d.stopped = false;
  d.mismatch.judged_by = JudgedBy::kPrediction;
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value());
  d.mismatch.judged_by = JudgedBy::kFreeRun;
  d.mismatch.after = 1.2e-4, d.model_gap->ci95 = {};
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value()) << "not determined";
  d.model_gap = ModelGap{GapOrigin::kGiven, 0.02, {}};
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value()) << "not its own";
}

TEST(Card, NamesWhatDiffersInTheUsersSimulator) {
  const Diagnosis d = slide_diagnosis();
  SimulatorComparison c;
  c.sentence = "Your simulator lacks nothing that these recordings would show. And so on.";
  CardFacts f = facts_of(nullptr, &d);
  f.simulated = &c;
  EXPECT_TOLD(card_of(f).cause);
  c.rows.resize(3);
  c.rows[0].differs = true, c.rows[0].sentence = "it has no cogging torque, the drive has (2 N)";
  EXPECT_TOLD(card_of(f).cause);
  c.rows[1].differs = c.rows[2].differs = true;
  c.rows[0].sentence = "its motor inertia is 2 kg where the drive's is 3 kg";
  EXPECT_TOLD(card_of(f).cause);
}

TEST(Card, TellsSizePlaceCauseAndWhatHelpsInOneUnit) {
  const Diagnosis d = slide_diagnosis();
  const Card card = card_of(facts_of(nullptr, &d));
  EXPECT_TOLD(card.mismatch);
  EXPECT_TOLD(card.place);
  EXPECT_TOLD(card.cause);
  EXPECT_TOLD(card.helps);
  EXPECT_DOUBLE_EQ(card.percent, 20.0);
  EXPECT_DOUBLE_EQ(card.percent_after, 4.0);
}

TEST(Card, TellsWhatIsStillUnexplained) {
  Diagnosis d = slide_diagnosis();
  d.budget.nominal = 10.0, d.budget.encoder = 0.1, d.budget.band_hz = 64.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).next);
  d.added.back().after_torque = kNaN;  // the budget has no size of it: it may take all of that
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).next);
  d.added.back().after_torque = 2.0, d.budget.encoder = 0.3;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).next);
  d.added.back().after_torque = 6.0, d.mismatch.after_torque = 6.0, d.budget.encoder = 1.5;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).next) << "most of it";
}

TEST(Card, TellsTheFloorInTheUnitOfTheSize) {
  Diagnosis d = slide_diagnosis();
  d.budget.nominal = 10.0, d.budget.records = 0.613, d.budget.encoder = 0.1, d.budget.band_hz = 64.0;
  d.budget.input = 50.0, d.budget.remains = 2.0;
  ASSERT_TRUE(d.budget.exists());
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch);
  d.budget.encoder = 0.7;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch);
  d.budget.repeatability = 0.72;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch);
  d.budget.repeatability = 1.2;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch);
  d.budget.repeatability = 3.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch) << "the model with what was added is below";
  d.budget.records = 20.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).mismatch) << "the floor is above what is missed";
}

TEST(Card, SaysWhereMostLikelyNothingOfTheCatalogueIsTheCause) {
  Diagnosis d = slide_diagnosis();
  d.verdict = DiagnosisVerdict::kHelps;
  for (AddedEffect& a : d.added) a.established = false;
  d.outside_probability = 0.88;
  d.ranking.resize(1);
  d.ranking.front().effect = d.effects.front();
  const Card card = card_of(facts_of(nullptr, &d));
  EXPECT_TOLD(card.cause);
  EXPECT_TOLD(card.next);
  d.added.back().established = true;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).cause);
  d.added.back().established = false;
  d.ranking.front().effect = "input_delay";  // another one was added: the budget decided
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).cause);
}

TEST(Card, JudgesTheToleranceThatWasStated) {
  const Answer answer = sharp_answer();
  const Diagnosis d = slide_diagnosis();
  CardFacts f = facts_of(&answer, &d);
  EXPECT_FALSE(card_of(f).good_enough.has_value());
  f.tolerance.torque_percent = 5.0;
  EXPECT_TOLD(card_of(f).mismatch);
  EXPECT_EQ(card_of(f).good_enough, std::optional(false));
  f.tolerance.torque_percent = 1.0;
  EXPECT_TOLD(card_of(f).mismatch);
  f.tolerance.torque_percent = 25.0;
  EXPECT_TOLD(card_of(f).mismatch);
  EXPECT_TOLD(card_of(f).next);
  f.tolerance.gap = 0.0195;  // within the interval of the gap
  EXPECT_FALSE(card_of(f).good_enough.has_value());
  EXPECT_TOLD(card_of(f).gap);
  f.tolerance.gap = 0.010;
  EXPECT_EQ(card_of(f).good_enough, std::optional(false));
  f.tolerance.gap = 0.021;
  EXPECT_EQ(card_of(f).good_enough, std::optional(true));
}

TEST(Card, AToleranceOfTheTorqueIsOpenWithoutADiagnosis) {
  const Answer answer = sharp_answer();
  CardFacts f = facts_of(&answer, nullptr);
  f.tolerance.torque_percent = 1.0;
  EXPECT_FALSE(card_of(f).good_enough.has_value());
  EXPECT_TOLD(card_of(f).mismatch);
}

TEST(Card, OfAnUnknownGapLeavesAsidesToTheDetail) {
  Answer answer;
  answer.sentence =
      "The gap is not known: the recording is inconclusive (too slow (much)). Rejected (8 floors).";
  const Card card = card_of(facts_of(&answer, nullptr));
  EXPECT_TOLD(card.gap);
}

TEST(Card, OfADriveThatLacksNothingSaysSoInEveryLine) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = 1e-6, d.mismatch.floor = 1.1e-6;
  d.mismatch.before_torque = 2e-4, d.mismatch.input_torque = 0.07;
  CardFacts f = facts_of(nullptr, &d);
  f.coordinates = Coordinates::kRotation;
  const Card card = card_of(f);
  EXPECT_TOLD(card.mismatch);
  EXPECT_THAT(card.codes.next, ElementsAre("next.nothing"));
  for (const CardLine& line : card.lines()) EXPECT_THAT(line.text, Not(::testing::IsEmpty())) << line.name;
}

}  // namespace
}  // namespace gapscope
