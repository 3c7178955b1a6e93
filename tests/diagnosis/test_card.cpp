#include <gmock/gmock.h>

#include "diagnosis/slide_card.h"
#include "gapscope/diagnosis/simulator.h"

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
  EXPECT_EQ(card.gap, answer.sentence + " Trust: good.");
  EXPECT_EQ(card.mismatch, "Not measured, as no model was fitted.");
  for (const std::string& line : {card.place, card.cause, card.helps, card.next})
    EXPECT_THAT(line, HasSubstr("`gapscope diagnose CONFIG`"));
  EXPECT_TRUE(std::isnan(card.torque));
  EXPECT_FALSE(card.diagnosed);
  Diagnosis d = slide_diagnosis();
  EXPECT_TRUE(card_of(facts_of(nullptr, &d)).diagnosed);
  EXPECT_EQ(card_of(facts_of(nullptr, &d)).gap, "Not estimated here; told by `gapscope run CONFIG`.");
  d.model_gap = ModelGap();
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).gap, HasSubstr("single body"));
  d.model_gap = ModelGap{GapOrigin::kGiven, 0.02, {}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).gap, StartsWith("The model takes the gap as known, 20 mm"));
  d.model_gap = ModelGap{GapOrigin::kEstimated, 0.02, {0.018, 0.022}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).gap, StartsWith("The fitted model does not follow"));
  d.mismatch.remains = 697.0;
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).gap,
      HasSubstr("to tell the gap, as it leaves 697 times the encoder's noise (told below 10 times); "));
  d.mismatch.remains = 2.0;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).gap,
              StartsWith("The recordings do not determine the gap of the fitted model; without"));
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
  EXPECT_EQ(good->sentence,
            "The backlash gap 2β (full width, at x1) is 20.0 mrad (95 %: 18.0 to 22.0) by the model "
            "that the diagnosis has fitted.");
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
  d.mismatch.measure = "prediction of an observer at 30 Hz";
  EXPECT_FALSE(answer_of_diagnosis(d, Coordinates()).has_value());
  d.mismatch.measure = "";
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
  EXPECT_THAT(card_of(f).cause, EndsWith(" Your simulator lacks nothing that these recordings would show."));
  c.rows.resize(3);
  c.rows[0].differs = true, c.rows[0].sentence = "it has no cogging torque, the drive has (2 N)";
  EXPECT_THAT(card_of(f).cause, EndsWith(" Your simulator has no cogging torque, the drive has (2 N)."));
  c.rows[1].differs = c.rows[2].differs = true;
  c.rows[0].sentence = "its motor inertia is 2 kg where the drive's is 3 kg";
  EXPECT_THAT(card_of(f).cause, EndsWith(" Your simulator's motor inertia is 2 kg where the drive's is 3 kg; "
                                         "2 more rows differ."));
}

TEST(Card, TellsSizePlaceCauseAndWhatHelpsInOneUnit) {
  const Diagnosis d = slide_diagnosis();
  const Card card = card_of(facts_of(nullptr, &d));
  EXPECT_EQ(card.mismatch,
            "With nothing added, the model misses 10 N rms of force on held-out data, 20 % of the 50 N rms "
            "that the input applies.");
  EXPECT_EQ(card.place,
            "The missing force depends on the direction of motion (55 % of its square backward).");
  EXPECT_EQ(
      card.cause,
      "Established: motor Coulomb friction. Not established, though it helps: cogging torque (it may as "
      "well be torque ripple).");
  EXPECT_EQ(card.helps,
            "The missing force falls from 10 N to 4 N with motor Coulomb friction, then to 2 N with cogging "
            "torque; "
            "in all from 20.0 % to 4.0 % of what the input applies; `fitted.yaml` has them.");
  EXPECT_DOUBLE_EQ(card.percent, 20.0);
  EXPECT_DOUBLE_EQ(card.percent_after, 4.0);
}

TEST(Card, TellsWhatIsStillUnexplained) {
  Diagnosis d = slide_diagnosis();
  d.budget.nominal = 10.0, d.budget.encoder = 0.1, d.budget.band_hz = 64.0;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).next,
              StartsWith("Do not rely on `DIR/fitted.yaml` yet: 4 % of the input's force is unexplained with "
                         "all that was found (20 times what the encoder's noise alone looks like). Record"));
  d.added.back().after_torque = kNaN;  // the budget has no size of it: it may take all of that
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).next, StartsWith("Simulate with `DIR/fitted.yaml`"));
  d.added.back().after_torque = 2.0, d.budget.encoder = 0.3;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).next, StartsWith("Simulate with `DIR/fitted.yaml`"));
  d.added.back().after_torque = 6.0, d.mismatch.after_torque = 6.0, d.budget.encoder = 1.5;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).next,
              HasSubstr(" of the input's force is unexplained with all that was found (4 times"))
      << "most of it";
}

TEST(Card, TellsTheFloorInTheUnitOfTheSize) {
  Diagnosis d = slide_diagnosis();
  d.budget.nominal = 10.0, d.budget.records = 0.613, d.budget.encoder = 0.1, d.budget.band_hz = 64.0;
  d.budget.input = 50.0, d.budget.remains = 2.0;
  ASSERT_TRUE(d.budget.exists());
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).mismatch,
      EndsWith(
          "input applies; the recordings disagree by 0.613 N of this: no one set of numbers removes it."));
  d.budget.encoder = 0.7;
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).mismatch,
      EndsWith("input applies; the encoder's noise alone looks like 0.7 N, below which no model can get."));
  d.budget.repeatability = 0.72;
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).mismatch,
      EndsWith("input applies; the encoder's noise alone looks like 0.72 N, below which no model can get."));
  d.budget.repeatability = 1.2;
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).mismatch,
      EndsWith("no model can get below 1.2 N, by which the drive itself differs from period to period."));
  d.budget.repeatability = 3.0;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).mismatch, Not(HasSubstr("no model can get below")))
      << "the model with what was added is below";
  d.budget.records = 20.0;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).mismatch, EndsWith("50 N rms that the input applies."))
      << "the floor is above what is missed";
}

TEST(Card, SaysWhereMostLikelyNothingOfTheCatalogueIsTheCause) {
  Diagnosis d = slide_diagnosis();
  d.verdict = DiagnosisVerdict::kHelps;
  for (AddedEffect& a : d.added) a.established = false;
  d.outside_probability = 0.88;
  d.ranking.resize(1);
  d.ranking.front().effect = d.effects.front();
  const Card card = card_of(facts_of(nullptr, &d));
  EXPECT_THAT(card.cause, StartsWith("Not established, though they help: "));
  EXPECT_THAT(card.cause, EndsWith(" Most likely (88 %) the cause is none of the catalogue's."));
  EXPECT_THAT(card.next,
              StartsWith("Simulate with `DIR/fitted.yaml`, which predicts best with all of these"));
  EXPECT_THAT(card.next,
              EndsWith("To settle the cause, record another motion (other speeds, other loads) and "
                       "diagnose again with that."));
  d.added.back().established = true;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).cause, Not(HasSubstr("ost likely")));
  d.added.back().established = false;
  d.ranking.front().effect = "input_delay";  // another one was added: the budget decided
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).cause, Not(HasSubstr("ost likely")));
}

TEST(Card, JudgesTheToleranceThatWasStated) {
  const Answer answer = sharp_answer();
  const Diagnosis d = slide_diagnosis();
  CardFacts f = facts_of(&answer, &d);
  EXPECT_FALSE(card_of(f).good_enough.has_value());
  f.tolerance.torque_percent = 5.0;
  EXPECT_THAT(card_of(f).mismatch, EndsWith("Outside your tolerance of 5 %, within it with what helps."));
  EXPECT_EQ(card_of(f).good_enough, std::optional(false));
  f.tolerance.torque_percent = 1.0;
  EXPECT_THAT(card_of(f).mismatch, EndsWith("Outside your tolerance of 1 %."));
  f.tolerance.torque_percent = 25.0;
  EXPECT_THAT(card_of(f).mismatch, EndsWith("Within your tolerance of 25 %."));
  EXPECT_EQ(card_of(f).next, "None: this is within your tolerance.");
  f.tolerance.gap = 0.0195;  // within the interval of the gap
  EXPECT_FALSE(card_of(f).good_enough.has_value());
  EXPECT_THAT(card_of(f).gap, EndsWith("Your tolerance of 19.5 mm cannot be judged."));
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
  EXPECT_THAT(card_of(f).mismatch, EndsWith("Your tolerance of 1 % of the force cannot be judged."));
}

TEST(Card, OfAnUnknownGapLeavesAsidesToTheDetail) {
  Answer answer;
  answer.sentence =
      "The gap is not known: the recording is inconclusive (too slow (much)). Rejected (8 floors).";
  const Card card = card_of(facts_of(&answer, nullptr));
  EXPECT_EQ(card.gap, "The gap is not known: the recording is inconclusive. Rejected. Trust: none.");
}

TEST(Card, OfADriveThatLacksNothingSaysSoInEveryLine) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = 1e-6, d.mismatch.floor = 1.1e-6;
  d.mismatch.before_torque = 2e-4, d.mismatch.input_torque = 0.07;
  CardFacts f = facts_of(nullptr, &d);
  f.coordinates = Coordinates::kRotation;
  const Card card = card_of(f);
  EXPECT_THAT(card.mismatch,
              StartsWith("The model misses 200 µN·m rms of torque on held-out data, 0.286 % of the "
                         "70 mN·m"));
  EXPECT_THAT(card.mismatch, HasSubstr("that is noise"));
  EXPECT_EQ(card.next, "None.");
  for (const CardLine& line : card.lines()) EXPECT_THAT(line.text, Not(::testing::IsEmpty())) << line.name;
}

}  // namespace
}  // namespace gapscope
