// The six lines as a report begins with them: an answer each, without the numbers and reasons behind it.
#include <gmock/gmock.h>

#include "diagnosis/simulator.h"
#include "support/told.h"
#include "telling/slide_card.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using testing::sharp_answer;
using testing::slide_diagnosis;

TEST(CardBrief, AnswersEveryLineInASentenceOrTwo) {
  const Answer answer = sharp_answer();
  Diagnosis d = slide_diagnosis();
  d.added.front().parameters = {{"level_nm", "N m", 20.0, {19.0, 21.0}}};
  const Card card = card_of(facts_of(&answer, &d));
  EXPECT_TOLD(card.brief.gap);
  EXPECT_TOLD(card.brief.mismatch);
  EXPECT_EQ(card.brief.place, card.place);
  EXPECT_TOLD(card.brief.cause);
  EXPECT_TOLD(card.brief.helps);
  EXPECT_TOLD(card.brief.next);
  EXPECT_TOLD(card.helps) << "the full line has it";
}

TEST(CardBrief, TellsThatTheRestIsNoiseAndWhichOwnNumbersHaveChanged) {
  Diagnosis d = slide_diagnosis();
  d.mismatch.remains = 1.1;
  d.refitted = {{"motor_inertia", "kg m^2", 0.114, 0.154, {0.1539, 0.1541}}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).brief.helps);
  d.refitted.resize(4, {"motor_damping", "N m s/rad", 0.1, 0.12, {0.119, 0.121}});
  d.refitted[1] = {"mass_ratio", "-", 0.893, 0.362, {0.361, 0.363}};
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).brief.helps);
  d.mismatch.remains = 3.0;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).brief.helps);
  d.mismatch.before_torque = d.mismatch.after_torque = kNaN;  // told in the motion
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kMotion, a.after_torque = kNaN;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).brief.helps);
  d.mismatch.remains = 0.9, d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_TOLD(card_of(facts_of(nullptr, &d)).brief.helps);
}

TEST(CardBrief, TakesTheModelToASimulatorWhereAFormatHasAllOfIt) {
  Diagnosis d = slide_diagnosis();
  CardFacts f = facts_of(nullptr, &d);
  f.carriers = {{"c"}};
  EXPECT_TOLD(card_of(f).brief.next);
}

TEST(CardBrief, KeepsWhatChangesTheAnswer) {
  const Answer answer = sharp_answer();
  Diagnosis d = slide_diagnosis();
  CardFacts f = facts_of(&answer, &d);
  f.constant_guessed = true;
  f.tolerance.torque_percent = 5.0;
  d.mismatch.after = 2.0 * d.mismatch.before;
  SimulatorComparison c;
  c.rows.resize(1);
  c.rows[0].differs = true, c.rows[0].sentence = "it has no cogging torque, the drive has (2 N)";
  f.simulated = &c;
  const Card card = card_of(f);
  EXPECT_TOLD(card.brief.mismatch);
  EXPECT_TOLD(card.brief.helps);
  EXPECT_TOLD(card.brief.cause);
}

TEST(CardBrief, SaysWhyTheTrustInAFittedGapIsLimited) {
  Answer answer = sharp_answer();
  answer.from = AnswerSource::kReference, answer.trust = AnswerTrust::kLimited;
  FitSummary fit;
  fit.why = Remark("above_floor", "It leaves something.");
  fit.innovation_rmse = 2.5e-5, fit.floor = 1e-5;
  CardFacts f = facts_of(&answer, nullptr);
  f.reference = &fit;
  EXPECT_TOLD(card_of(f).brief.gap);
  fit.why = Remark("values_move", "Its parts disagree.");
  EXPECT_TOLD(card_of(f).brief.gap);
}

TEST(CardBrief, OfAStoppedDiagnosisIsToGoOn) {
  Answer answer = sharp_answer();
  answer.next = {"For a reading without a model: record more."};
  Diagnosis d = slide_diagnosis();
  d.stopped = true;
  EXPECT_TOLD(card_of(facts_of(&answer, &d)).brief.next);
}

TEST(CardBrief, OfWhatIsNotKnownSaysSoWithoutTheReason) {
  Answer answer;
  answer.sentence =
      "The gap is not known: the recording is inconclusive (too slow). The model is rejected: it misses.";
  CardFacts f = facts_of(&answer, nullptr);
  EXPECT_TOLD(card_of(f).brief.gap);
  answer.sentence =
      "The lost motion at zero torque is 30 mrad (95 %: 17 to 43); the gap is at most 43 mrad. It is mostly "
      "a gap. And so on.";
  f.lost_motion = true;
  EXPECT_TOLD(card_of(f).brief.gap);
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kUnknown;
  d.budget.band_hz = 8.0;
  d.budget.rungs = {{"load_unbalance", "load_unbalance", false, 12.6, 2.43, 0.963, {0.9, 0.98}, 0.9, 0.9}};
  f.diagnosis = &d;
  EXPECT_TOLD(card_of(f).brief.cause);
  EXPECT_EQ(card_of(f).codes.helps.front(), "helps.not_established");
  d.budget.rungs.clear();
  EXPECT_TOLD(card_of(f).brief.cause);
}

TEST(AmountWords, TellPeriodAndAmount) {
  Diagnosis d = slide_diagnosis();
  d.added.back().parameters = {{"amplitude_nm", "N m", 2.0, {1.9, 2.1}},
                               {"phase_rad", "rad", 0.5},
                               {"periods_per_turn", "1/rev", 2.0 * kPi / 5e-3}};
  EXPECT_EQ(amount_words(d.added.front(), d, Coordinates::kTranslation), "");
  EXPECT_TOLD(amount_words(d.added.back(), d, Coordinates::kTranslation));
  d.added.back().group.resize(1);
  EXPECT_TOLD(amount_words(d.added.back(), d, Coordinates::kTranslation));
  d.added.back().effect = "stribeck_friction";
  d.added.back().parameters = {{"level_nm", "N m", 20.0}, {"stiction_ratio", "-", -0.4, {-0.5, -0.3}}};
  EXPECT_TOLD(amount_words(d.added.back(), d, Coordinates::kTranslation));
}

}  // namespace
}  // namespace gapscope
