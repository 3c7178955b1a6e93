// The six lines as a report begins with them: an answer each, without the numbers and reasons behind it.
#include <gmock/gmock.h>

#include "diagnosis/card_words.h"
#include "diagnosis/slide_card.h"
#include "gapscope/diagnosis/simulator.h"

namespace gapscope {
namespace {

using internal::diagnosis::first_clause;
using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using testing::sharp_answer;
using testing::slide_diagnosis;

TEST(FirstClause, EndsOutsideOfBracketsCodeAndNumbers) {
  EXPECT_EQ(first_clause("1.5 mrad (a; b. c), read; more. And more."), "1.5 mrad (a; b. c), read.");
  EXPECT_EQ(first_clause("Run `a; b` now. Then stop."), "Run `a; b` now.");
  EXPECT_EQ(first_clause("unknown, though x: y", ":"), "Unknown, though x.");
  EXPECT_EQ(first_clause("All of it"), "All of it.");
  EXPECT_EQ(first_clause(""), "");
}

TEST(CardBrief, AnswersEveryLineInASentenceOrTwo) {
  const Answer answer = sharp_answer();
  Diagnosis d = slide_diagnosis();
  d.added.front().parameters = {{"level_nm", "N m", 20.0, {19.0, 21.0}}};
  const Card card = card_of(facts_of(&answer, &d));
  EXPECT_EQ(card.brief.gap,
            "The backlash gap is 19.0 mrad (95 %: 18.0 to 20.0), measured without a model. Trust: good.");
  EXPECT_EQ(card.brief.mismatch,
            "With nothing added, the model misses 10 N rms of force on held-out data, 20 % of the 50 N rms "
            "that the input applies.");
  EXPECT_EQ(card.brief.place, card.place);
  EXPECT_EQ(card.brief.cause,
            "Established: motor Coulomb friction. Not established, though it helps: cogging torque or torque "
            "ripple.");
  EXPECT_EQ(card.brief.helps,
            "The missing force falls from 10 N to 4 N with motor Coulomb friction, then to 2 N with cogging "
            "torque.");
  EXPECT_THAT(card.brief.next, ::testing::StartsWith("Simulate with `DIR/fitted.yaml`"));
  EXPECT_THAT(card.brief.next, ::testing::Not(HasSubstr("export")));
  EXPECT_THAT(card.helps, HasSubstr("(20.0 N, 95 %: 19.0 to 21.0)")) << "the full line has it";
}

TEST(CardBrief, TellsThatTheRestIsNoiseAndWhichOwnNumbersHaveChanged) {
  Diagnosis d = slide_diagnosis();
  d.mismatch.remains = 1.1;
  d.refitted = {{"motor_inertia", "kg m^2", 0.114, 0.154, {0.1539, 0.1541}}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).brief.helps,
              HasSubstr("; what is left is noise. Numbers that the fit has changed: motor inertia"));
  d.refitted.resize(4, {"motor_damping", "N m s/rad", 0.1, 0.12, {0.119, 0.121}});
  d.refitted[1] = {"mass_ratio", "-", 0.893, 0.362, {0.361, 0.363}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).brief.helps,
              HasSubstr("mass ratio 0.893 → 0.3620, motor inertia"));
  d.mismatch.remains = 3.0;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).brief.helps, ::testing::Not(HasSubstr("noise")));
  d.mismatch.before_torque = d.mismatch.after_torque = kNaN;  // told in the motion
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kMotion, a.after_torque = kNaN;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).brief.helps,
              HasSubstr("; what is left, 3 times the encoder's noise, is not explained."));
  d.mismatch.remains = 0.9, d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).brief.helps,
              HasSubstr("; what is left is no more than the drive varies by itself."));
}

TEST(CardBrief, TakesTheModelToASimulatorWhereAFormatHasAllOfIt) {
  Diagnosis d = slide_diagnosis();
  CardFacts f = facts_of(nullptr, &d);
  f.carriers = {{"c"}};
  EXPECT_THAT(card_of(f).brief.next, HasSubstr("`gapscope export DIR --to c -o DIR_c`"));
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
  EXPECT_THAT(card.brief.mismatch, HasSubstr(" All torques here rest on torque_constant, a guess;"));
  EXPECT_THAT(card.brief.mismatch, EndsWith(" Outside your tolerance of 5 %, within it with what helps."));
  EXPECT_THAT(card.brief.helps, EndsWith(", but the simulated motion comes no nearer."));
  EXPECT_THAT(card.brief.cause, EndsWith(" Your simulator has no cogging torque, the drive has (2 N)."));
}

TEST(CardBrief, SaysWhyTheTrustInAFittedGapIsLimited) {
  Answer answer = sharp_answer();
  answer.from = AnswerSource::kReference, answer.trust = AnswerTrust::kLimited;
  FitSummary fit;
  fit.why = Remark("above_floor", "It leaves something.");
  fit.innovation_rmse = 2.5e-5, fit.floor = 1e-5;
  CardFacts f = facts_of(&answer, nullptr);
  f.reference = &fit;
  EXPECT_THAT(
      card_of(f).brief.gap,
      HasSubstr(" Trust: limited (the model leaves 2.5 times the encoder's noise, and the interval does "
                "not hold what it lacks)."));
  fit.why = Remark("values_move", "Its parts disagree.");
  EXPECT_THAT(card_of(f).brief.gap, EndsWith(" Trust: limited."));
}

TEST(CardBrief, OfAStoppedDiagnosisIsToGoOn) {
  Answer answer = sharp_answer();
  answer.next = {"For a reading without a model: record more."};
  Diagnosis d = slide_diagnosis();
  d.stopped = true;
  EXPECT_EQ(card_of(facts_of(&answer, &d)).brief.next, "Run `gapscope diagnose CONFIG` to its end.");
}

TEST(CardBrief, OfWhatIsNotKnownSaysSoWithoutTheReason) {
  Answer answer;
  answer.sentence =
      "The gap is not known: the recording is inconclusive (too slow). The model is rejected: it misses.";
  CardFacts f = facts_of(&answer, nullptr);
  EXPECT_EQ(card_of(f).brief.gap, "The gap is not known: the recording is inconclusive.");
  answer.sentence =
      "The lost motion at zero torque is 30 mrad (95 %: 17 to 43); the gap is at most 43 mrad. It is mostly "
      "a gap. And so on.";
  f.lost_motion = true;
  EXPECT_EQ(card_of(f).brief.gap,
            "The lost motion at zero torque is 30 mrad (95 %: 17 to 43); the gap is at most 43 mrad. It is "
            "mostly a gap.");
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kUnknown;
  d.budget.band_hz = 8.0;
  d.budget.rungs = {{"load_unbalance", "load_unbalance", false, 12.6, 2.43, 0.963, {0.9, 0.98}, 0.9, 0.9}};
  f.diagnosis = &d;
  EXPECT_EQ(card_of(f).brief.cause, "Unknown, though load unbalance is suspected.");
  EXPECT_EQ(card_of(f).brief.helps, "Nothing that these recordings establish.");
  d.budget.rungs.clear();
  EXPECT_EQ(card_of(f).brief.cause, "Unknown, as no effect of the catalogue explains it.");
}

TEST(AmountWords, TellPeriodAndAmount) {
  Diagnosis d = slide_diagnosis();
  d.added.back().parameters = {{"amplitude_nm", "N m", 2.0, {1.9, 2.1}},
                               {"phase_rad", "rad", 0.5},
                               {"periods_per_turn", "1/rev", 2.0 * kPi / 5e-3}};
  EXPECT_EQ(amount_words(d.added.front(), d, Coordinates::kTranslation), "");
  EXPECT_EQ(amount_words(d.added.back(), d, Coordinates::kTranslation),
            "every 5 mm; amplitude 2.00 N, 95 %: 1.90 to 2.10; it may as well be torque ripple");
  d.added.back().group.resize(1);
  EXPECT_EQ(amount_words(d.added.back(), d, Coordinates::kTranslation),
            "every 5 mm; amplitude 2.00 N, 95 %: 1.90 to 2.10");
  d.added.back().effect = "stribeck_friction";
  d.added.back().parameters = {{"level_nm", "N m", 20.0}, {"stiction_ratio", "-", -0.4, {-0.5, -0.3}}};
  EXPECT_THAT(amount_words(d.added.back(), d, Coordinates::kTranslation),
              ::testing::StartsWith("as inverse Stribeck friction: -40 % of the Coulomb friction"));
}

}  // namespace
}  // namespace gapscope
