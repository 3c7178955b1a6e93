#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/sample_run.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

TEST(Wording, ShowsTheDigitsThatTheIntervalWarrants) {
  EXPECT_EQ(with_interval(0.01872, {0.0185, 0.0189}, "rad"), "18.72 mrad (95 %: 18.50 to 18.90)");
  EXPECT_EQ(plus_minus(0.0188, {0.018771, 0.018829}, "rad"), "18.800 ± 0.029 mrad");
  EXPECT_EQ(plus_minus(0.0188, {}, "rad"), "18.8 mrad");
  EXPECT_EQ(beside_interval(0.01899997, {0.01899987, 0.01900007}, "rad"), "18.99997 mrad");
  EXPECT_EQ(beside_interval(0.01897, {0.01882, 0.01912}, "rad"), "18.97 mrad");
  EXPECT_EQ(beside_interval(0.01897, {}, "rad"), "19.0 mrad");
  EXPECT_EQ(fit_text(99.9987), "> 99.99 %");
  EXPECT_EQ(fit_text(100.0), "100 %");
  EXPECT_EQ(fit_text(96.154), "96.15 %");
  EXPECT_EQ(plus_minus(2e-5, {0.0, 4.2e-4}, "m"), with_interval(2e-5, {0.0, 4.2e-4}, "m"));
  EXPECT_EQ(plus_minus(0.0, {-3.2e-5, 3.2e-5}, "kg m²"), "0 ± 3.2·10⁻⁵ kg m²");
  EXPECT_EQ(plus_minus(8.7812e-4, {8.7722e-4, 8.7902e-4}, "kg m²"), "8.7812·10⁻⁴ ± 9.0·10⁻⁷ kg m²");
  EXPECT_EQ(plus_minus(8.78e-4, {6.78e-4, 1.078e-3}, "kg m²"), "8.8·10⁻⁴ ± 2.0·10⁻⁴ kg m²");
  EXPECT_EQ(interval_text({0.018771, 0.018829}, "rad"), "18.771 to 18.829 mrad");
  EXPECT_EQ(interval_text({}, "rad"), "");
}

TEST(Wording, NamesTheUnknownAndTheVerySmall) {
  EXPECT_EQ(quantity(kNaN, "rad"), "unknown");
  EXPECT_EQ(quantity(0.0, "rad"), "0 rad");
  EXPECT_EQ(quantity(8.78e-4, "kg m²"), "8.78·10⁻⁴ kg m²");
  EXPECT_EQ(quantity(1.2, "-"), "1.20");
}

TEST(Wording, NumbersOfATableShareTheUnitOfTheLargest) {
  EXPECT_EQ(quantity_beside(84.6e-6, 18.9e-3, "rad"), "0.0846 mrad");
  EXPECT_EQ(quantity_beside(0.44, 9.8, "N"), "0.440 N");
  EXPECT_EQ(quantity_beside(2.0, 0.5, "N"), quantity(2.0, "N")) << "nothing larger";
  EXPECT_EQ(quantity_beside(3e-9, 1.0, "N"), "3.00·10⁻⁹ N");
  EXPECT_EQ(quantity_beside(kNaN, 1.0, "N"), "unknown");
}

TEST(Wording, TypesetsNumbers) {
  EXPECT_EQ(typeset("-0.5..-0.1 rad, 3e-05 N, run-2.csv, 1.2e+06"),
            "−0.5..−0.1 rad, 3·10⁻⁵ N, run-2.csv, 1.2·10⁶");
  EXPECT_EQ(typeset("-0.000..0.031 m"), "0.000..0.031 m") << "no minus before a zero";
  EXPECT_EQ(rounded(-0.02), "−0.02");
  EXPECT_EQ(rounded(8813.7), "8810");
  EXPECT_EQ(rounded(210.0, 2), "210");
  EXPECT_EQ(rounded(0.0), "0");
  EXPECT_EQ(rounded(-5.86e-5), "−5.86·10⁻⁵");
  EXPECT_EQ(rounded(kNaN), "–");
}

TEST(Headline, TellsEveryVerdict) {
  RunResult run = sample_run({.samples = 6000});
  EXPECT_EQ(
      estimates_text(run),
      "Without a model: backlash gap 18.91 mrad (95 %: 18.62 to 19.21). Fitted model: 18.828 mrad "
      "(95 %: 18.799 to 18.858). They agree: the difference is 0.0846 mrad, its standard deviation 0.151 mrad.");
  run.comparison->agree = false;
  EXPECT_NE(headline(run).find("They disagree"), std::string::npos);
  run.comparison->agree.reset();
  run.model_free->verdict = GapVerdict::kNone;
  EXPECT_NE(headline(run).find("no backlash above 400 µrad"), std::string::npos);
  run.model_free->lost_motion.gap_limit = 1e-4;
  EXPECT_NE(headline(run).find("no backlash above 100 µrad"), std::string::npos) << "the loop binds more";
  run.model_free->verdict = GapVerdict::kInconclusive;
  run.model_free->reason = Remark::said("no periodic motion");
  EXPECT_NE(headline(run).find("inconclusive (no periodic motion)."), std::string::npos);
  run.reference->parameters[4].identifiable = false;
  EXPECT_NE(headline(run).find("could not determine the gap"), std::string::npos);
  run.reference->status = FitStatus::kNotConverged;
  EXPECT_NE(headline(run).find("did not converge"), std::string::npos);
}

/// A model that misses its recording, whose interval is narrow all the same.
RunResult rejected_run() {
  RunResult run = sample_run({.samples = 6000});
  run.reference->trust = FitTrust::kRejected;
  run.reference->why = Remark::said("The model misses 65 % of what the torque does to the motion.");
  return run;
}

TEST(Headline, BeginsWithTheAnswerWhereThereIsOne) {
  RunResult run = sample_run({.samples = 6000});
  run.answer =
      Answer{0.0188, {}, AnswerSource::kReference, AnswerTrust::kGood, "The backlash gap is so much.", {}};
  EXPECT_EQ(headline(run), "The backlash gap is so much.");
  EXPECT_TRUE(estimates_text(run).starts_with("Without a model: backlash gap 18.91 mrad"));
}

TEST(Headline, OfARejectedModelHasNoIntervalAndSaysWhatItMisses) {
  RunResult run = rejected_run();
  run.model_free.reset(), run.comparison.reset();
  EXPECT_EQ(estimates_text(run),
            "The fitted model is rejected, its gap (18.8 mrad) is not to be believed: The model misses "
            "65 % of what the torque does to the motion.");
}

TEST(Headline, OfAFitThatDidNotConvergeHasNoInterval) {
  RunResult run = sample_run({.samples = 6000});
  run.model_free.reset(), run.comparison.reset();
  run.reference->status = FitStatus::kNotConverged;
  EXPECT_THAT(estimates_text(run), ::testing::AllOf(::testing::HasSubstr("did not converge"),
                                                    ::testing::Not(::testing::HasSubstr("±")),
                                                    ::testing::Not(::testing::HasSubstr("95 %"))));
}

TEST(Accuracy, OfARejectedModelSpeaksOfNoInterval) {
  RunResult run = rejected_run();
  run.model_free.reset();
  EXPECT_EQ(accuracy(run), "The fitted gap is 0.15 % above the simulated gap.");
}

TEST(Accuracy, SaysWhetherTheIntervalHoldsTheTruth) {
  RunResult run = sample_run({.samples = 6000});
  EXPECT_EQ(
      accuracy(run),
      "The gap read without a model is 0.60 % above the simulated gap; its interval holds it. The fitted gap "
      "is 0.15 % above the simulated gap; its interval holds it.");
  run.simulated_gap = 0.02;
  EXPECT_NE(accuracy(run).find("below the simulated gap; its interval misses it"), std::string::npos);
  run.simulated_gap = kNaN;
  EXPECT_NE(accuracy(run).find("read off the x1–x2 map"), std::string::npos);
  run.comparison->map_width = kNaN;
  EXPECT_EQ(accuracy(run), "");
}

}  // namespace
}  // namespace gapscope::internal::report
