// What the card says of the cause, of the trust and of the controller.
#include <gmock/gmock.h>

#include "gapscope/diagnosis/answer.h"
#include "gapscope/diagnosis/card.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 0.1 N m, of which friction takes 0.06 and a delay 0.02 more.
Diagnosis of_friction_and_delay(bool first, bool second) {
  Diagnosis d;
  d.verdict = first ? DiagnosisVerdict::kEffect : DiagnosisVerdict::kHelps;
  d.effects = {"motor_coulomb_friction", "input_delay"};
  d.added = {{"motor_coulomb_friction",
              first,
              {"motor_coulomb_friction", "quadratic_drag"},
              kNaN,
              {},
              0.6,
              {},
              0.04},
             {"input_delay", second, {"input_delay"}, kNaN, {}, 0.5, {}, 0.02}};
  d.mismatch.before = 3e-3, d.mismatch.after = 1e-3, d.mismatch.floor = 1e-4;
  d.mismatch.before_torque = 0.1, d.mismatch.after_torque = 0.02, d.mismatch.input_torque = 0.5;
  return d;
}

Card card_of(const Diagnosis& d) {
  CardFacts f;
  f.diagnosis = &d;
  return gapscope::card_of(f);
}

TEST(CardCause, ALaterOneIsEstablishedWithAnOpenFirstOneInTheModel) {
  EXPECT_EQ(
      card_of(of_friction_and_delay(false, true)).cause,
      "Motor Coulomb friction helps, but its cause is open: it may as well be quadratic drag; with it in the "
      "model, input delay is established.");
}

TEST(CardCause, OneOfAGroupIsNotCalledEstablished) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_EQ(
      card_of(d).cause,
      "Input delay (established); motor Coulomb friction or quadratic drag: these recordings cannot tell "
      "them apart.");
  d.added[0].group.pop_back();
  EXPECT_EQ(card_of(d).cause, "Motor Coulomb friction and input delay (established).");
  d.added[1].established = false;
  EXPECT_EQ(card_of(d).cause,
            "Motor Coulomb friction (established); input delay helps, but its cause is open.");
}

TEST(CardCause, TellsThatTheRecordingsLeaveAnAmountOpen) {
  Diagnosis d = of_friction_and_delay(false, false);
  d.added[0].parameters = {{"level_nm", "N m", 274.0}};
  d.added[0].at_bound = {"level_nm"};
  d.added[1].parameters = {{"delay_s", "s", 0.003, {0.002, 0.004}}};
  EXPECT_EQ(
      card_of(d).cause,
      "Motor Coulomb friction and input delay help, but their causes are open: it may as well be quadratic "
      "drag, and these recordings do not determine how much motor Coulomb friction there is.");
  EXPECT_THAT(card_of(d).helps, HasSubstr("motor Coulomb friction (274 N·m, at the bound of its search)"));
  d.added[0].group.pop_back(), d.added[0].at_bound.clear(), d.added.pop_back();
  EXPECT_EQ(card_of(d).cause,
            "Motor Coulomb friction helps, but its cause is open: these recordings do not determine how much "
            "there is of it.");
  EXPECT_THAT(card_of(d).helps, HasSubstr("friction (274 N·m, which the recordings do not determine)"));
}

TEST(CardCause, TellsThatTheSearchEndedAtItsLimit) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 10.0;
  EXPECT_THAT(card_of(d).cause, Not(HasSubstr("limit of work")));
  d.exhausted = true;
  EXPECT_THAT(card_of(d).cause,
              HasSubstr(" The search ended at its limit of work, so that further causes may "
                        "have been missed."));
  d.mismatch.remains = 1.1;
  EXPECT_THAT(card_of(d).cause, Not(HasSubstr("limit of work"))) << "nothing is left to be found";
}

/// 12.6 N m of 1.24, of which an unbalance takes nearly all in the error budget and is not established.
Diagnosis unknown_beside_a_budget() {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kUnknown;
  d.mismatch.before_torque = d.mismatch.after_torque = 12.6, d.mismatch.input_torque = 1.24;
  d.budget.band_hz = 8.0;
  d.budget.rungs = {{"load_unbalance", "load_unbalance", false, 12.6, 2.43, 0.963, {0.9, 0.98}, 0.9, 0.9}};
  return d;
}

TEST(CardCause, OfUnknownTellsWhatTheBudgetHasAndWhyItIsNotEstablished) {
  Diagnosis d = unknown_beside_a_budget();
  EXPECT_EQ(card_of(d).cause,
            "Unknown: in the error budget load unbalance brings the missing torque down from 12.6 to 2.43 "
            "N·m, but no model "
            "with it follows the recordings well enough to establish it.");
  EXPECT_EQ(card_of(d).helps, "Nothing that these recordings establish.");
  d.better_swapped = true;
  EXPECT_EQ(card_of(d).cause,
            "Unknown: in the error budget load unbalance brings the missing torque down from 12.6 to 2.43 "
            "N·m, but the "
            "recording that was fitted moves too little to establish a cause.");
  d.next_experiment.sentence = "Record a sine.";
  EXPECT_THAT(card_of(d).next, HasSubstr("Swap the recordings")) << "takes no new one";
  d.next_experiment = {};
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("12.6 N·m of torque on held-out data, 10 times the 1.24 N·m"));
  d.budget.rungs.front().share = 0.3, d.better_swapped = false;
  EXPECT_EQ(card_of(d).cause, "Unknown: no effect of the catalogue explains it.");
  EXPECT_THAT(card_of(d).next, HasSubstr("Record the drive in another motion"));
}

TEST(CardMismatch, TellsHowFarAFreeSimulationDeparts) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr(" Simulated freely from the first sample on, the model departs from the held-out motion "
                "by up to 407 mrad, of 876 mrad of travel; with what was added, by up to 41.2 mrad."));
  d.whole_run->before = 54.2;
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr("by up to 54.2 rad, of 0.876 rad of travel; with what was added, by "
                        "up to 0.0412 rad."));
  d.whole_run->before = kNaN;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr("sample on, the model runs away; with what was added, it departs from the held-out motion "
                "by up to 41.2 mrad, of 876 mrad of travel."));
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_THAT(card_of(d).mismatch, Not(HasSubstr("Simulated freely"))) << "a drive that holds a position";
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

TEST(CardMismatch, TellsTheErrorUnderTheController) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_THAT(card_of(d).mismatch, Not(HasSubstr("controller")));
  d.closed_loop = ClosedLoop{0.392, 0.0561, {}};
  EXPECT_THAT(card_of(d).mismatch, HasSubstr(" Under its controller the model is 392 mrad off; with what was "
                                             "added it is 56.1 mrad off (rms of the position)."));
  d.closed_loop->before = kNaN;
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("the model runs away; with what was added it is 56.1 mrad off"));
  d.closed_loop->before = 0.392, d.added.clear();
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("the model is 392 mrad off (rms of the position)."));
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

}  // namespace
}  // namespace gapscope
