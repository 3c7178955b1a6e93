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
      "Motor Coulomb friction helps, its cause is open: it may as well be quadratic drag; with it in the "
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
  EXPECT_EQ(card_of(d).cause, "Motor Coulomb friction (established); input delay helps, its cause is open.");
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
