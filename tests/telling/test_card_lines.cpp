// What the card says of the gap, of the trust in it and of the model's error.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "support/told.h"
#include "telling/answer.h"

namespace gapscope {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CardMismatch, TellsHowFarAFreeSimulationDeparts) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_TOLD(card_of(d).mismatch);
  d.whole_run->after = 0.9;
  EXPECT_TOLD(card_of(d).mismatch);
  d.whole_run->after = 1.4;
  EXPECT_TOLD(card_of(d).mismatch) << "more than small errors of the numbers add up to";
  d.whole_run->after = 0.0412;
  d.whole_run->before = 54.2;
  EXPECT_TOLD(card_of(d).mismatch);
  d.whole_run->before = kNaN;
  EXPECT_TOLD(card_of(d).mismatch);
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_TOLD(card_of(d).mismatch) << "a drive that holds a position";
}

TEST(CardMismatch, TellsHowFarOffTheConfigurationWasBeforeTheFit) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = {{"motor_damping", "N m s/rad", 0.1, 0.12, {0.11, 0.13}}};
  d.mismatch.before = 0.017, d.mismatch.after = 0.0071, d.mismatch.measure = "free runs";
  EXPECT_TOLD(card_of(d).brief.mismatch) << "it left numbers to the fit";
  d.as_configured = AsConfigured{0.382};
  EXPECT_TOLD(card_of(d).brief.mismatch);
  d.as_configured->error = kNaN;
  EXPECT_TOLD(card_of(d).mismatch);
  d.mismatch.measure = "prediction of an observer";
  EXPECT_TOLD(card_of(d).mismatch);
  d.as_configured->error = 0.018;
  EXPECT_TOLD(card_of(d).mismatch) << "hardly more than refitted";
}

TEST(CardTrust, IsInAGapWhereLostMotionIsMeasured) {
  Answer answer;
  answer.sentence = "The lost motion at zero torque is 30 mrad (95 %: 17 to 43); the gap is at most 43 mrad.";
  CardFacts f;
  f.answer = &answer, f.lost_motion = true;
  EXPECT_TOLD(gapscope::card_of(f).gap);
  f.lost_motion = false;
  EXPECT_TOLD(gapscope::card_of(f).gap);
}

TEST(CardTrust, OfPlayIsInItsBoundOfTheGap) {
  Answer answer;
  answer.from = AnswerSource::kModelFree, answer.trust = AnswerTrust::kLimited;
  answer.sentence = "The play at zero torque is 27 mrad, so the gap is at most that.";
  CardFacts f;
  f.answer = &answer;
  EXPECT_TOLD(gapscope::card_of(f).gap);
}

TEST(CardMismatch, NamesTheEffectsThatTheModelHasAlready) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_TOLD(card_of(d).mismatch);
  d.modelled = {"cogging_torque", "load_unbalance"};
  EXPECT_TOLD(card_of(d).mismatch);
}

TEST(CardMismatch, TellsTheErrorUnderTheController) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_TOLD(card_of(d).mismatch);
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_TOLD(card_of(d).mismatch);
  d.closed_loop->before = kNaN;
  EXPECT_TOLD(card_of(d).mismatch);
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_TOLD(card_of(d).mismatch);
  d.closed_loop->before = 0.392;
  EXPECT_TOLD(card_of(d).mismatch);
  d.whole_run.reset();
  d.closed_loop->before = 0.392, d.added.clear();
  EXPECT_TOLD(card_of(d).mismatch);
}

TEST(CardMismatch, OfAModelAsGoodAsTheRecordingHasTheNoiseBesideIt) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = 0.429e-3, d.mismatch.floor = 0.354e-3;
  EXPECT_TOLD(card_of(d).mismatch);
  d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_TOLD(card_of(d).mismatch);
}

TEST(CardPlace, SaysWhereAPeriodIsLongerThanTheMotion) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.where.headline = "is periodic in the motor angle, once per turn; only forward motion was recorded";
  d.where.periods_per_turn = 1.0;
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_TOLD(card_of(d).place);
  d.where.periods_per_turn = 24.0;
  EXPECT_TOLD(card_of(d).place);
  d.where.headline = "depends on the input level", d.where.periods_per_turn = 1.0;
  EXPECT_TOLD(card_of(d).place);
}

TEST(CardHelps, TellsWhatIsLeft) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 1.2;
  EXPECT_TOLD(card_of(d).helps);
  d.mismatch.remains = 45.0;
  EXPECT_TOLD(card_of(d).helps);
  d.mismatch.remains = 4500.0, d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_TOLD(card_of(d).helps);
  d.budget.nominal = 0.1, d.budget.records = 4e-3, d.budget.encoder = 1e-3, d.budget.band_hz = 64.0;
  d.budget.input = 0.5, d.budget.remains = 0.02;
  EXPECT_THAT(card_of(d).helps,
              ContainsRegex(
                  " Of the [0-9.]+ mN·m left the recordings disagree by 4 mN·m; the rest is not explained"));
  d.traces.resize(1), d.traces.front().scored_from = 100;
  EXPECT_TOLD(card_of(d).helps);
  d.budget.encoder = 5e-3;
  EXPECT_THAT(
      card_of(d).helps,
      ContainsRegex(
          " Of the [0-9.]+ mN·m left no model gets below 5 mN·m; what is above that is not explained"));
}

TEST(CardHelps, WhereTheBalanceTellsNoTorqueEachEffectHasTheErrorThatItLeaves) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.before_torque = d.mismatch.after_torque = kNaN;
  d.mismatch.before = 0.138, d.mismatch.after = 2e-6, d.mismatch.floor = 1e-6;
  d.mismatch.measure = "free run restarted every 0.5 s";
  d.added[0].shrink = (0.138 - 1e-3) / (0.138 - 1e-6), d.added[1].shrink = (1e-3 - 2e-6) / (1e-3 - 1e-6);
  EXPECT_TOLD(card_of(d).helps);
  d.mismatch.measure.clear();
  EXPECT_TOLD(card_of(d).helps);
  d.added[0].shrink = 0.5;  // not what all of them leave
  EXPECT_TOLD(card_of(d).helps);
}

TEST(CardNext, OfAModelThatDriftsSaysWhatItIsGoodFor) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.whole_run = WholeRun{1.29, 0.231, 0.876};
  EXPECT_TOLD(card_of(d).next);
  d.added[1].established = false;
  EXPECT_TOLD(card_of(d).next);
  d.whole_run->after = kNaN;
  EXPECT_TOLD(card_of(d).next);
  d.whole_run->before = kNaN;
  EXPECT_TOLD(card_of(d).next);
  d.whole_run->after = 0.0412;
  EXPECT_TOLD(card_of(d).next);
}

TEST(CardGap, OfASingleBodyThatLacksNothingIsNotMissed) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone, d.model_gap = ModelGap();
  EXPECT_TOLD(card_of(d).gap);
}

TEST(CardNext, OfOneDirectionAsksForTheOtherBeforeTheSearchGoesOn) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.exhausted = true, d.mismatch.remains = 45.0;
  EXPECT_TOLD(card_of(d).next);
  d.where.direction = {{"backward", 0.0, 0.0}, {"forward", 1.0, 1.0}};
  EXPECT_TOLD(card_of(d).next);
}

TEST(CardGap, OfAnEncoderOnTheLoadIsNotSentToTheDetector) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.model_gap = ModelGap();
  d.traces.resize(1);
  EXPECT_TOLD(card_of(d).gap);
  d.traces.front().encoder = EncoderSide::kLoad;
  for (const GapOrigin origin : {GapOrigin::kNone, GapOrigin::kGiven, GapOrigin::kEstimated}) {
    d.model_gap->origin = origin;
    EXPECT_TOLD(card_of(d).gap);
  }
}

TEST(CardGap, OfASingleBodyWithItsEncoderOnTheLoadDoesNotShow) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.model_gap = ModelGap();
  d.model_gap->encoder = EncoderSide::kLoad;  // of one body its traces are of the motor, too
  EXPECT_TOLD(card_of(d).gap);
}

}  // namespace
}  // namespace gapscope
