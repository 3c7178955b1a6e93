#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "diagnosis/comparison.h"
#include "support/told.h"
#include "telling/answer.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

GapEstimate reading(double gap, double half) {
  GapEstimate g;
  g.verdict = GapVerdict::kBacklash;
  g.gap = gap, g.ci95 = {gap - half, gap + half};
  g.trust = GapTrust::kGood;
  return g;
}

GapEstimate denying(double least) {
  GapEstimate g;
  g.verdict = GapVerdict::kNone;
  g.smallest_visible_gap = least;
  return g;
}

GapEstimate undecided() {
  GapEstimate g;
  g.verdict = GapVerdict::kInconclusive;
  g.reason = Remark("too_slow", "no impact to be expected.");
  return g;
}

FitSummary fitted(FitTrust trust, double gap, double half) {
  FitSummary f;
  f.status = FitStatus::kConverged;
  f.trust = trust;
  f.why = trust == FitTrust::kRejected ? Remark("leaves_unexplained", "The model misses 65 % of the motion.")
                                       : Remark("above_floor", "It follows the recording to 98 %.");
  f.innovation_rmse = 0.65, f.coasting_rmse = 1.0;
  FittedParameter p;
  p.key = "gap", p.value = gap, p.ci95 = {gap - half, gap + half}, p.std = half / 1.96;
  p.estimated = p.identifiable = true;
  f.parameters = {p};
  return f;
}

Answer of(const GapEstimate* g, const FitSummary* f, std::optional<bool> agree = {}) {
  return answer_of({g, f, agree, {}});
}

TEST(Answer, OfAFirstGapTheWholeIsToldByTheModelThatAsksForIt) {
  GapEstimate g = reading(0.0247, 6e-4);
  const FitSummary whole = fitted(FitTrust::kLimited, 0.0332, 3e-3),
                   near = fitted(FitTrust::kLimited, 0.0258, 1e-4);
  take_for_first_gap(near, g);
  EXPECT_EQ(g.quantity, GapQuantity::kGap) << "within an eighth";
  take_for_first_gap(whole, g);
  ASSERT_EQ(g.quantity, GapQuantity::kFirstGap);
  EXPECT_EQ(g.trust, GapTrust::kLimited);
  const Answer a = of(&g, &whole);
  EXPECT_EQ(a.from, AnswerSource::kReference);
  EXPECT_EQ(a.trust, AnswerTrust::kLimited);
  EXPECT_THAT(a.codes, ElementsAre("gap.reference", "gap.model_free.first"));
  EXPECT_THAT(a.next_codes, ::testing::Contains("next.hold_output"));
}

TEST(Answer, OfASecondImpactFirstAndWholeAreTold) {
  GapEstimate g = reading(0.0247, 6e-4);
  g.quantity = GapQuantity::kFirstGap, g.trust = GapTrust::kLimited, g.whole = 0.034;
  const Answer a = of(&g, nullptr);
  EXPECT_EQ(a.from, AnswerSource::kModelFree);
  EXPECT_EQ(a.trust, AnswerTrust::kLimited);
  EXPECT_DOUBLE_EQ(a.gap, 0.0247);
  EXPECT_THAT(a.codes, ElementsAre("gap.first"));
  const FitSummary fit = fitted(FitTrust::kLimited, 0.0332, 3e-3);
  EXPECT_THAT(of(&g, &fit).codes, ElementsAre("gap.first", "gap.first.reference"));
}

TEST(Answer, OfWhatIsNotReadABoundIsTold) {
  GapEstimate g = undecided();
  g.gap_at_most = 0.05;
  const Answer a = of(&g, nullptr);
  EXPECT_TRUE(a.says("gap.at_most.if_any"));
  EXPECT_DOUBLE_EQ(a.gap_at_most, 0.05);
  EXPECT_EQ(a.trust, AnswerTrust::kNone);
}

TEST(Answer, OfTwoThatAgreeIsTheSharperOneThatIsGood) {
  const GapEstimate g = reading(0.019, 2e-4);
  const FitSummary good = fitted(FitTrust::kGood, 0.0191, 1.2e-5),
                   blunt = fitted(FitTrust::kGood, 0.0191, 1e-3);
  const Answer a = of(&g, &good, true);
  EXPECT_EQ(a.from, AnswerSource::kReference);
  EXPECT_EQ(a.trust, AnswerTrust::kGood);
  EXPECT_EQ(a.gap, 0.0191);
  EXPECT_TOLD(a.sentence);
  EXPECT_EQ(of(&g, &blunt, true).from, AnswerSource::kModelFree);
  const FitSummary limited = fitted(FitTrust::kLimited, 0.0191, 1e-5);
  EXPECT_EQ(of(&g, &limited, true).from, AnswerSource::kModelFree)
      << "a limited model goes behind any reading";
}

TEST(Answer, AFitWhoseIntervalAgreesWithAnythingIsNotSaidToAgree) {
  const GapEstimate g = reading(0.019, 2e-4);
  const FitSummary wide = fitted(FitTrust::kLimited, 0.012, 9e-3);
  const Answer a = of(&g, &wide, true);
  EXPECT_EQ(a.from, AnswerSource::kModelFree);
  EXPECT_FALSE(a.says("gap.reference.agrees"));
  const FitSummary apart = fitted(FitTrust::kLimited, 0.008, 2.1e-3);
  const Answer b = of(&g, &apart, false);
  EXPECT_TRUE(b.says("gap.reference.contradicts"));
  EXPECT_EQ(b.trust, AnswerTrust::kLimited) << "a wide interval contradicts as well as a narrow one";
}

TEST(Answer, OfTwoThatContradictEachOtherIsLimitedAndNamesBoth) {
  const GapEstimate g = reading(0.019, 2e-4);
  const FitSummary good = fitted(FitTrust::kGood, 0.025, 2.1e-4),
                   limited = fitted(FitTrust::kLimited, 0.025, 2.1e-4);
  const Answer by_good = of(&g, &good, false), by_limited = of(&g, &limited, false);
  EXPECT_EQ(by_good.from, AnswerSource::kReference);
  EXPECT_EQ(by_limited.from, AnswerSource::kModelFree);
  for (const Answer& a : {by_good, by_limited}) {
    EXPECT_EQ(a.trust, AnswerTrust::kLimited);
    EXPECT_TOLD(a.sentence);
    EXPECT_EQ(a.codes.back(), a.from == AnswerSource::kReference ? "gap.model_free.contradicts"
                                                                 : "gap.reference.contradicts");
    EXPECT_EQ(a.next_codes.front(), "next.once_more");
  }
}

TEST(Answer, NeverTakesTheNumberOfARejectedModel) {
  const FitSummary rejected = fitted(FitTrust::kRejected, 0.0249, 5e-4);
  const GapEstimate g = reading(0.019, 2e-4), none = denying(1e-3), open = undecided();
  EXPECT_EQ(of(&g, &rejected).gap, 0.019);
  EXPECT_EQ(of(&g, &rejected).trust,
            AnswerTrust::kLimited);  // what the model lacks may move the reading, too
  EXPECT_TOLD(of(&none, &rejected).sentence);
  EXPECT_TOLD(of(&none, nullptr).sentence);
  for (const Answer& a : {of(nullptr, &rejected), of(&open, &rejected)}) {
    EXPECT_EQ(a.from, AnswerSource::kNone);
    EXPECT_EQ(a.trust, AnswerTrust::kNone);
    EXPECT_TRUE(std::isnan(a.gap));
    EXPECT_TRUE(std::isnan(a.ci95.low));
    EXPECT_TOLD(a.sentence);
    EXPECT_THAT(a.next_codes, ::testing::Contains("next.diagnose.lacks"));
  }
}

TEST(Answer, WhereAGapIsReadARejectedModelLeadsToTheDiagnosisAndNotToOneWithoutAGap) {
  const GapEstimate g = reading(0.0087, 2e-4), open = undecided();
  for (const char* code : {"as_well_without_gap", "gap_bears_little", "gap_differs", "gap_at_bound"}) {
    FitSummary rejected = fitted(FitTrust::kRejected, 0.0249, 5e-4);
    rejected.why = Remark(code, "It says so.");
    EXPECT_THAT(of(&g, &rejected).next_codes, ElementsAre("next.diagnose.lacks")) << code;
  }
  FitSummary rejected = fitted(FitTrust::kRejected, 0.0249, 5e-4);
  rejected.why = Remark("as_well_without_gap", "It says so.");
  EXPECT_EQ(of(&open, &rejected).next_codes.front(), "next.without_gap");
}

TEST(Answer, OfAFitThatClosesTheGapAgreesWithADenial) {
  FitSummary closed = fitted(FitTrust::kRejected, 0.0, 1e-4);
  closed.why = Remark("as_well_without_gap", "The recording is explained as well without a gap.");
  closed.parameters[0].at_bound = true, closed.parameters[0].low = 0.0, closed.parameters[0].high = 0.3;
  const GapEstimate none = denying(1e-3), open = undecided();
  const Answer a = of(&none, &closed);
  EXPECT_TOLD(a.sentence);
  EXPECT_EQ(a.trust, AnswerTrust::kGood);
  EXPECT_THAT(a.codes, ElementsAre("none.model_free", "none.reference.agrees"));
  EXPECT_TRUE(a.next.empty());
  EXPECT_TOLD(of(&open, &closed).sentence);
  closed.parameters[0].value = 0.3;
  EXPECT_TOLD(of(&none, &closed).sentence) << "at the upper bound";
}

TEST(Answer, OfAFitThatDidNotConvergeHasNoInterval) {
  FitSummary unsettled = fitted(FitTrust::kLimited, 0.00903, 1e-4);
  unsettled.status = FitStatus::kNotConverged;
  const GapEstimate open = undecided(), g = reading(0.019, 2e-4);
  const Answer a = of(&open, &unsettled);
  EXPECT_TOLD(a.sentence);
  EXPECT_TRUE(std::isnan(a.ci95.low));
  EXPECT_TOLD(of(&g, &unsettled, false).sentence);
}

TEST(Answer, OfAModelThatCoastingBeatsAsksForTheSignFirst) {
  FitSummary rejected = fitted(FitTrust::kRejected, 0.0249, 5e-4);
  rejected.innovation_rmse = 1.7;
  EXPECT_EQ(of(nullptr, &rejected).next_codes.front(), "next.sign");
}

/// The step says what the reason says: who is told to go faster is not sent to a slow triangle.
TEST(Answer, OfASlowMotionAsksForAFasterOne) {
  GapEstimate g = undecided();
  g.reason = Remark("only_large_gaps", "could only have shown a large gap; use a faster excitation");
  EXPECT_THAT(of(&g, nullptr).next_codes, ElementsAre("next.faster"));
  g.reason = Remark("few_passages", "too few passages");
  EXPECT_THAT(of(&g, nullptr).next_codes, ElementsAre("next.free_motion"));
}

TEST(Answer, RepeatsWhatTheReasonSaysToChange) {
  GapEstimate g = undecided();
  g.reason = Remark("gap_uncertain", "a gap of 8.3 mrad is seen, but only to 11 %: ") +
             Remark("few_counts", "it is 22 counts wide, and about 26 are needed; 1 bit more, or a triangle");
  EXPECT_THAT(of(&g, nullptr).next_codes, ElementsAre("next.advice"));
  EXPECT_TOLD(of(&g, nullptr).next.front());
  g.reason = Remark("no_t1", "no t1") + Remark("nothing_reads", "; nor does auto: ") + g.reason;
  EXPECT_TOLD(of(&g, nullptr).next.front());
}

TEST(Answer, OfABoundThatReadsNothingIsTheBoundToTry) {
  GapEstimate g = undecided();
  g.reason = Remark("bound_above_gap_mode", "no t1") +
             Remark("bounds_to_try", "; try L between {:.2g} and {:.2g}", {3.0, 6.0});
  const Answer a = of(&g, nullptr);
  EXPECT_THAT(a.next_codes, ElementsAre("next.bound_as_told"));
}

TEST(Answer, TellsTheLostMotionThatWasMeasuredWhateverItMeans) {
  GapEstimate open;
  open.verdict = GapVerdict::kInconclusive;
  open.lost_motion.value = 0.0338, open.lost_motion.ci95 = {0.0330, 0.0346};
  open.lost_motion.levels.resize(2);
  open.lost_motion.levels[0].lost_motion = 0.0338, open.lost_motion.levels[0].amplitude = 4.0;
  open.lost_motion.levels[1].amplitude = 25.0, open.lost_motion.levels[1].lost_motion = 0.0374;
  open.lost_motion.gap_limit = 0.0353, open.lost_motion.cause = LostMotionCause::kOpen;
  const Answer a = of(&open, nullptr);
  EXPECT_TRUE(std::isnan(a.gap));
  EXPECT_EQ(a.from, AnswerSource::kNone);
  EXPECT_TOLD(a.sentence);
  EXPECT_THAT(a.next_codes, ElementsAre("next.smaller_ramps"));
  FitSummary rejected = fitted(FitTrust::kRejected, 0.04, 5e-4);
  rejected.why = Remark("leaves_unexplained", "It misses much.");
  EXPECT_THAT(of(&open, &rejected).next_codes, ElementsAre("next.smaller_ramps", "next.diagnose.lacks"));
  open.lost_motion.levels.pop_back();
  EXPECT_THAT(of(&open, nullptr).next_codes, ElementsAre("next.two_levels"));
  EXPECT_TRUE(answer_of({&open, nullptr, {}, {}, 0.03}).says("gap.beyond_travel")) << "of 30 mrad of travel";
  open.lost_motion.cause = LostMotionCause::kFriction, open.lost_motion.gap_limit = kNaN;
  EXPECT_TOLD(of(&open, nullptr).sentence);
}

TEST(Answer, TheLoopOfTheSmallestTorqueBindsADenialThatAllowsMore) {
  GapEstimate none;
  none.verdict = GapVerdict::kNone;
  none.smallest_visible_gap = 0.0517;
  EXPECT_TOLD(of(&none, nullptr).sentence);
  none.lost_motion.value = 0.0029, none.lost_motion.gap_limit = 0.0031;
  EXPECT_TOLD(of(&none, nullptr).sentence);
  none.smallest_visible_gap = 0.001;
  EXPECT_TOLD(of(&none, nullptr).sentence);
}

TEST(Answer, TakesTheModelWhereTheReadingIsInconclusiveOrWasNotAskedFor) {
  const FitSummary good = fitted(FitTrust::kGood, 0.0191, 1e-5),
                   limited = fitted(FitTrust::kLimited, 0.0191, 1e-5);
  const GapEstimate open = undecided();
  EXPECT_EQ(of(&open, &good).trust, AnswerTrust::kGood);
  EXPECT_EQ(of(nullptr, &limited).trust, AnswerTrust::kLimited);
  EXPECT_EQ(of(nullptr, &limited).gap, 0.0191);
  EXPECT_TOLD(of(&open, nullptr).sentence);
  const FitSummary rejected = fitted(FitTrust::kRejected, 0.0191, 1e-5);
  EXPECT_TOLD(of(&open, &rejected).sentence);
  EXPECT_TRUE(of(&open, &rejected).says("gap.not_known"));
}

TEST(Answer, TrustsADenialWithoutAModelLessAndTellsItsShareOfTheTravel) {
  const GapEstimate none = denying(0.1911);
  const FitSummary small = fitted(FitTrust::kGood, 5e-4, 1e-5);
  const Answer alone = answer_of({&none, nullptr, {}, {}, 1.737});
  EXPECT_TOLD(alone.sentence);
  EXPECT_EQ(alone.trust, AnswerTrust::kLimited);
  EXPECT_EQ(answer_of({&none, &small, {}, {}, 1.737}).trust, AnswerTrust::kGood) << "a good model agrees";
}

TEST(Answer, HoldsADeniedGapAgainstTheModel) {
  const FitSummary small = fitted(FitTrust::kGood, 5e-4, 1e-5), large = fitted(FitTrust::kGood, 5e-3, 1e-5);
  const GapEstimate none = denying(1e-3);
  EXPECT_EQ(of(&none, &small).from, AnswerSource::kReference);
  EXPECT_EQ(of(&none, &small).trust, AnswerTrust::kGood);
  EXPECT_EQ(of(&none, &large).trust, AnswerTrust::kLimited);
  EXPECT_TRUE(std::isnan(of(&none, &large).gap));
}

TEST(Answer, CallsPlayAtZeroTorqueALimitOfTheGapAndNotTheGap) {
  GapEstimate play = reading(0.034, 5e-4);
  play.quantity = GapQuantity::kPlayAtZeroTorque;
  const Answer a = of(&play, nullptr);
  EXPECT_TRUE(std::isnan(a.gap));
  EXPECT_EQ(a.trust, AnswerTrust::kLimited);
  EXPECT_TOLD(a.sentence);
}

TEST(Answer, SaysFirstThatTheConfigurationHoldsAnotherGapThanItReads) {
  const GapEstimate g = reading(0.019, 2e-4);
  FitSummary holds = fitted(FitTrust::kRejected, 0.08, 0.0);
  holds.parameters.front().estimated = false;
  EXPECT_EQ(of(&g, &holds).next_codes.front(), "next.estimate_gap");
  EXPECT_TOLD(of(&g, &holds).next.front());
  const FitTrust rejected = std::exchange(holds.trust, FitTrust::kGood);
  EXPECT_THAT(of(&g, &holds).next_codes, Not(::testing::Contains("next.estimate_gap")))
      << "a good fit bears it out";
  holds.trust = rejected, holds.parameters.front().value = 0.0191;
  EXPECT_THAT(of(&g, &holds).next_codes, Not(::testing::Contains("next.estimate_gap")));
}

TEST(Answer, HasAtMostThreeStepsAndMillimetresOnASlide) {
  FitSummary rejected = fitted(FitTrust::kRejected, 0.0249, 5e-4);
  rejected.innovation_rmse = 1.7;
  const GapEstimate open = undecided(), g = reading(0.0019, 2e-5);
  EXPECT_LE(of(&open, &rejected).next.size(), 3u);
  const Answer slide = answer_of({&g, nullptr, {}, Coordinates::kTranslation});
  EXPECT_TOLD(slide.sentence);
}

}  // namespace
}  // namespace gapscope
