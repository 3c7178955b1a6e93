// What the card says of the gap, of the trust in it and of the model's error.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "gapscope/diagnosis/answer.h"

namespace gapscope {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CardMismatch, TellsHowFarAFreeSimulationDeparts) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr(" Simulated freely from the first sample on, the model drifts up to 407 mrad from "
                "the held-out motion, whose travel is 876 mrad; with the additions below, up to 41.2 mrad."));
  d.whole_run->after = 0.9;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr("with the additions below, up to 900 mrad: over so long a run the smallest errors grow."));
  d.whole_run->after = 1.4;
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("with the additions below, up to 1.4 rad."))
      << "more than small errors of the numbers add up to";
  d.whole_run->after = 0.0412;
  d.whole_run->before = 54.2;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr(
          "up to 54.2 rad from the held-out motion, whose travel is 0.876 rad; with the additions below, "
          "up to 41.2 mrad."));
  d.whole_run->before = kNaN;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr(
          "sample on, the model runs away; with the additions below, it drifts up to 41.2 mrad from the "
          "held-out motion, whose travel is 876 mrad."));
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_THAT(card_of(d).mismatch, Not(HasSubstr("Simulated freely"))) << "a drive that holds a position";
}

TEST(CardMismatch, TellsHowFarOffTheConfigurationWasBeforeTheFit) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = {{"motor_damping", "N m s/rad", 0.1, 0.12, {0.11, 0.13}}};
  d.mismatch.before = 0.017, d.mismatch.after = 0.0071, d.mismatch.measure = "free runs";
  EXPECT_THAT(card_of(d).brief.mismatch, Not(HasSubstr("As configured"))) << "it left numbers to the fit";
  d.as_configured = AsConfigured{0.382};
  EXPECT_THAT(
      card_of(d).brief.mismatch,
      HasSubstr(" As configured the simulated motion is 382 mrad off, refitted it is 17 mrad off, with "
                "the additions 7.1 mrad."));
  d.as_configured->error = kNaN;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr("the simulated motion runs away, refitted it is 17 mrad off, with the additions 7.1 mrad "
                "(free runs)."));
  d.mismatch.measure = "prediction of an observer";
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("As configured the predicted motion runs away"));
  d.as_configured->error = 0.018;
  EXPECT_THAT(card_of(d).mismatch, Not(HasSubstr("As configured"))) << "hardly more than refitted";
}

TEST(CardTrust, IsInAGapWhereLostMotionIsMeasured) {
  Answer answer;
  answer.sentence = "The lost motion at zero torque is 30 mrad (95 %: 17 to 43); the gap is at most 43 mrad.";
  CardFacts f;
  f.answer = &answer, f.lost_motion = true;
  EXPECT_EQ(gapscope::card_of(f).gap,
            answer.sentence + " Trust in a gap: none; the lost motion is measured.");
  f.lost_motion = false;
  EXPECT_THAT(gapscope::card_of(f).gap, HasSubstr("43 mrad. Trust: none."));
}

TEST(CardTrust, OfPlayIsInItsBoundOfTheGap) {
  Answer answer;
  answer.from = AnswerSource::kModelFree, answer.trust = AnswerTrust::kLimited;
  answer.sentence = "The play at zero torque is 27 mrad, so the gap is at most that.";
  CardFacts f;
  f.answer = &answer;
  EXPECT_EQ(gapscope::card_of(f).gap,
            answer.sentence + " Trust: good as an upper bound, limited as the gap itself.");
}

TEST(CardMismatch, NamesTheEffectsThatTheModelHasAlready) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_THAT(card_of(d).mismatch,
              ::testing::StartsWith("With nothing added, the model misses 100 mN·m rms of torque"));
  d.modelled = {"cogging_torque", "load_unbalance"};
  EXPECT_THAT(
      card_of(d).mismatch,
      ::testing::StartsWith("With nothing added, the model, which has cogging torque and load unbalance, "
                            "misses 100 mN·m rms of torque"));
}

TEST(CardMismatch, TellsTheErrorUnderTheController) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_THAT(card_of(d).mismatch, Not(HasSubstr("controller")));
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr(" With its controller in the loop the model is 392 mrad rms off in "
                        "position; with the additions below, it is 56.1 mrad rms off in position."));
  d.closed_loop->before = kNaN;
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr("the model runs away; with the additions below, it is 56.1 mrad rms off"));
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("the model runs away; with the additions"));
  d.closed_loop->before = 0.392;
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr("is 392 mrad rms off in position (the travel is 876 mrad); with the "));
  d.whole_run.reset();
  d.closed_loop->before = 0.392, d.added.clear();
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("the model is 392 mrad rms off in position."));
}

TEST(CardMismatch, OfAModelAsGoodAsTheRecordingHasTheNoiseBesideIt) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = 0.429e-3, d.mismatch.floor = 0.354e-3;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr("; that is noise: the simulated motion is 429 µrad rms off, the encoder's noise alone "
                "makes 354 µrad (up to 1.3 times as much counts as noise)."));
  d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr("off, the drive itself differs from period to period by 354 µrad"));
}

TEST(CardPlace, SaysWhereAPeriodIsLongerThanTheMotion) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.where.headline = "periodic in the motor angle, once per turn; only forward motion was recorded";
  d.where.periods_per_turn = 1.0;
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_THAT(card_of(d).place, HasSubstr("once per turn (the held-out motion covers 0.14 turns, less than a "
                                          "period); only forward motion was "
                                          "recorded."));
  d.where.periods_per_turn = 24.0;
  EXPECT_THAT(card_of(d).place, Not(HasSubstr("less than a period")));
  d.where.headline = "depends on the input level", d.where.periods_per_turn = 1.0;
  EXPECT_THAT(card_of(d).place, Not(HasSubstr("less than a period")));
}

TEST(CardHelps, TellsWhatIsLeft) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 1.2;
  EXPECT_THAT(card_of(d).helps,
              HasSubstr("`fitted.yaml` has them. What is left does not show above the encoder's noise."));
  d.mismatch.remains = 45.0;
  EXPECT_THAT(card_of(d).helps, HasSubstr(" What is left, 45 times the encoder's noise, is not explained."));
  d.mismatch.remains = 4500.0, d.mismatch.floor_from = FloorSource::kRepeatability;
  EXPECT_THAT(card_of(d).helps, HasSubstr("left, 4500 times what the drive itself varies by from period to"));
  d.budget.nominal = 0.1, d.budget.records = 4e-3, d.budget.encoder = 1e-3, d.budget.band_hz = 64.0;
  d.budget.input = 0.5, d.budget.remains = 0.02;
  EXPECT_THAT(card_of(d).helps,
              ContainsRegex(
                  " Of the [0-9.]+ mN·m left the recordings disagree by 4 mN·m; the rest is not explained"));
  d.traces.resize(1), d.traces.front().scored_from = 100;
  EXPECT_THAT(card_of(d).helps, HasSubstr(" left the recording's parts disagree by 4 mN·m; the rest"));
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
  EXPECT_THAT(
      card_of(d).helps,
      HasSubstr("The free-run error (free run restarted every 0.5 s) falls from 138 mrad to 1 mrad with "));
  EXPECT_THAT(card_of(d).helps, HasSubstr(", then to 2 µrad with "));
  d.mismatch.measure.clear();
  EXPECT_THAT(card_of(d).helps, HasSubstr("The free-run error falls from 138 mrad to 1 mrad with "));
  d.added[0].shrink = 0.5;  // not what all of them leave
  EXPECT_THAT(card_of(d).helps, Not(HasSubstr("falls from 138 mrad")));
}

TEST(CardNext, OfAModelThatDriftsSaysWhatItIsGoodFor) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.whole_run = WholeRun{1.29, 0.231, 0.876};
  EXPECT_THAT(
      card_of(d).next,
      HasSubstr(
          "Simulate with `DIR/fitted.yaml`, for short motions alone (simulated over a whole recording it "
          "drifts by 26 % of the travel); "));
  d.added[1].established = false;
  EXPECT_THAT(card_of(d).next, HasSubstr("causes or not, for short motions alone (simulated over "));
  d.whole_run->after = kNaN;
  EXPECT_THAT(card_of(d).next,
              HasSubstr("never whole recordings (over one it runs away, without what was added 1.29 rad)"));
  d.whole_run->before = kNaN;
  EXPECT_THAT(card_of(d).next, HasSubstr("over a whole recording it runs away)"));
  d.whole_run->after = 0.0412;
  EXPECT_THAT(card_of(d).next, HasSubstr("causes or not; "));
}

TEST(CardGap, OfASingleBodyThatLacksNothingIsNotMissed) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone, d.model_gap = ModelGap();
  EXPECT_THAT(
      card_of(d).gap,
      HasSubstr("as the model is a single body, which is as good as the recording; to check without a model: "
                "`gapscope detect CONFIG`."));
}

TEST(CardNext, OfOneDirectionAsksForTheOtherBeforeTheSearchGoesOn) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.exhausted = true, d.mismatch.remains = 45.0;
  EXPECT_THAT(card_of(d).next, HasSubstr("Go on from what was found: `gapscope diagnose"));
  d.where.direction = {{"backward", 0.0, 0.0}, {"forward", 1.0, 1.0}};
  EXPECT_THAT(card_of(d).next,
              HasSubstr("Record both directions, too: without them causes stay open. To go on "));
}

TEST(CardGap, OfAnEncoderOnTheLoadIsNotSentToTheDetector) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.model_gap = ModelGap();
  d.traces.resize(1);
  EXPECT_THAT(card_of(d).gap, HasSubstr("`gapscope detect CONFIG`"));
  d.traces.front().encoder = EncoderSide::kLoad;
  for (const GapOrigin origin : {GapOrigin::kNone, GapOrigin::kGiven, GapOrigin::kEstimated}) {
    d.model_gap->origin = origin;
    EXPECT_THAT(card_of(d).gap, HasSubstr(": that takes the motor's position, which is not recorded."));
    EXPECT_THAT(card_of(d).gap, Not(HasSubstr("gapscope detect")));
  }
}

TEST(CardGap, OfASingleBodyWithItsEncoderOnTheLoadDoesNotShow) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.model_gap = ModelGap();
  d.model_gap->encoder = EncoderSide::kLoad;  // of one body its traces are of the motor, too
  EXPECT_EQ(card_of(d).gap,
            "Backlash is not examined: with the encoder on the load only a model with a gap can tell it "
            "(`gapscope init` with --model gap).");
}

}  // namespace
}  // namespace gapscope
