// What the card says of the gap, of the trust in it and of the model's error.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "gapscope/diagnosis/answer.h"

namespace gapscope {
namespace {

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
  d.whole_run->after = 0.0412;
  d.whole_run->before = 54.2;
  EXPECT_THAT(
      card_of(d).mismatch,
      HasSubstr(
          "up to 54.2 rad from the held-out motion, whose travel is 876 mrad; with the additions below, "
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

TEST(CardMismatch, NamesTheEffectsThatTheModelHasAlready) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_THAT(card_of(d).mismatch, ::testing::StartsWith("The model misses 100 mN·m rms of torque"));
  d.modelled = {"cogging_torque", "load_unbalance"};
  EXPECT_THAT(card_of(d).mismatch,
              ::testing::StartsWith("The model, which has cogging torque and load unbalance, "
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
  d.closed_loop->before = 0.392, d.added.clear();
  EXPECT_THAT(card_of(d).mismatch, HasSubstr("the model is 392 mrad rms off in position."));
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
            "Backlash is not modelled (a single body); the encoder is on the load, so that none would show.");
}

}  // namespace
}  // namespace gapscope
