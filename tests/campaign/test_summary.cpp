#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "campaign/answers.h"
#include "campaign/axis_names.h"
#include "campaign/pair_scorer.h"
#include "campaign/score.h"
#include "campaign/small_campaign.h"
#include "campaign/summary.h"

namespace gapscope {
namespace {

using internal::campaign::answers;
using internal::campaign::axis_name;
using internal::campaign::median_ci95;
using internal::campaign::PairScorer;
using internal::campaign::range_in_words;
using internal::campaign::Scorer;
using internal::campaign::with_unit;
using testing::SmallCampaign;

/// A run on a drive of 2β = 10 mrad in which both answered.
CampaignRow answered(double gap, double half, double reference_gap) {
  CampaignRow row;
  row.true_gap = 0.01;
  row.model_free.outcome = "backlash";
  row.model_free.answers = row.reference.answers = true;
  row.model_free.gap = gap;
  row.model_free.std = half / 2.0;
  row.model_free.ci95 = {gap - half, gap + half};
  row.reference.outcome = "converged";
  row.reference.gap = reference_gap;
  row.reference.std = 5e-6;
  row.reference.ci95 = {reference_gap - 1e-5, reference_gap + 1e-5};
  row.agree = std::abs(gap - reference_gap) <= half;
  return row;
}

CampaignHeader asking(bool literal, bool model_free, bool reference) {
  CampaignHeader header;
  header.literal = literal;
  header.model_free = model_free;
  header.reference = reference;
  return header;
}

TEST(Score, CountsErrorsBiasCoverageAndRefusals) {
  Scorer scorer(asking(false, true, true));
  scorer.add(answered(0.0101, 2e-4, 0.01));
  scorer.add(answered(0.0104, 2e-4, 0.01));
  scorer.add(answered(0.0098, 3e-4, 0.0103));
  CampaignRow silent = answered(0.01, 1e-4, 0.01);
  silent.model_free.outcome = "none";
  silent.model_free.answers = silent.reference.answers = false;
  silent.agree.reset();
  scorer.add(silent);
  CampaignRow failed;
  failed.error = "no";
  scorer.add(failed);
  const SummaryCell cell = scorer.cell();
  EXPECT_EQ(cell.runs, 5);
  EXPECT_EQ(cell.failed, 1);
  EXPECT_EQ(cell.model_free.runs, 4);
  EXPECT_EQ(cell.model_free.answered, 3);
  EXPECT_EQ(cell.model_free.denied, 1);
  EXPECT_EQ(cell.model_free.covered, 2);
  EXPECT_EQ(cell.model_free.within_1, 0 + 1);
  EXPECT_EQ(cell.model_free.within_5, 3);
  EXPECT_NEAR(cell.model_free.median_error, 0.02, 1e-12);
  EXPECT_NEAR(cell.model_free.bias, 0.01, 1e-12);
  EXPECT_NEAR(cell.model_free.refusal(), 0.25, 1e-12);
  const double scores[] = {4e-2 + 0.0, 4e-2 + 40 * 2e-2, 6e-2};
  EXPECT_NEAR(cell.model_free.interval_score, mean(scores), 1e-12);
  EXPECT_NEAR(cell.model_free.median_width, 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(cell.model_free.bias_ci.low)) << "three runs give no interval";
  EXPECT_EQ(cell.reference.answered, 3);
  EXPECT_EQ(cell.reference.covered, 2);
  EXPECT_EQ(cell.both, 3);
  EXPECT_EQ(cell.disagree, 2);
  EXPECT_EQ(cell.model_free_nearer, 1);  // 9.8 mrad is nearer to 10 than 10.3
}

TEST(Score, TheMediansIntervalIsThatOfTheOrderStatistics) {
  std::vector<double> values;
  for (int i = 1; i <= 10; ++i) values.push_back(i);
  const Interval ten = median_ci95(values);  // P(at most 1 of 10 below) = 0.011, at most 2: 0.055
  EXPECT_EQ(ten.low, 2.0);
  EXPECT_EQ(ten.high, 9.0);
  EXPECT_TRUE(std::isnan(median_ci95({1.0, 2.0, 3.0, 4.0, 5.0}).low));
  values.assign(5000, 1.0);
  EXPECT_EQ(median_ci95(values).low, 1.0);
}

TEST(Score, LiteralAnswersWithoutAnInterval) {
  Scorer scorer(asking(true, true, true));
  CampaignRow row = answered(0.01, 1e-4, 0.01);
  row.literal.answers = true;
  row.literal.gap = 0.0096;
  scorer.add(row);
  const EstimatorScore literal = scorer.cell().literal;
  EXPECT_EQ(literal.judged, 1);
  EXPECT_EQ(literal.within_5, 1);
  EXPECT_EQ(literal.claimed, 0);
  EXPECT_TRUE(std::isnan(literal.coverage()));
}

TEST(PairScorer, CountsOnWhatBothAnswerAndTellsTheCorrelationOfTheErrors) {
  PairScorer contest("model_free", &CampaignRow::model_free, "reference", &CampaignRow::reference);
  for (int i = -10; i <= 10; ++i) {  // both err alike, the first ten times as far
    CampaignRow row = answered(0.01 + 1e-5 * i, 1.96e-5 * 5.0, 0.01 + 1e-6 * i);
    contest.add(row);
    row.reference.answers = false;
    contest.add(row);
  }
  const EstimatorPair p = contest.pair();
  EXPECT_EQ(p.both, 21);
  EXPECT_EQ(p.claimed, 21);
  EXPECT_EQ(p.first_nearer, 0);
  EXPECT_NEAR(p.first_error, 5e-3, 1e-12);
  EXPECT_NEAR(p.second_error, 5e-4, 1e-12);
  EXPECT_NEAR(p.correlation, 1.0, 1e-12);
  EXPECT_GE(p.disagree_correlated, p.disagree);
}

TEST(Score, WithoutATrueGapNothingIsJudged) {
  Scorer scorer(asking(false, true, false));
  CampaignRow row = answered(0.01, 1e-4, 0.01);
  row.true_gap = kNaN;
  scorer.add(row);
  EXPECT_EQ(scorer.cell().model_free.answered, 1);
  EXPECT_EQ(scorer.cell().model_free.judged, 0);
  EXPECT_TRUE(std::isnan(scorer.cell().model_free.coverage()));
  EXPECT_EQ(scorer.cell().reference.runs, 0);
}

TEST(Words, TellWhichValuesAreGood) {
  const std::vector<SummaryBin> bits = {{"12 bit", 12}, {"14 bit", 14}, {"16 bit", 16}, {"20 bit", 20}};
  EXPECT_EQ(range_in_words(bits, {false, false, true, true}), "at least 16 bit");
  EXPECT_EQ(range_in_words(bits, {false, false, false, true}), "20 bit");
  EXPECT_EQ(range_in_words(bits, {true, true, false, false}), "at most 14 bit");
  EXPECT_EQ(range_in_words(bits, {false, true, true, false}), "14 to 16 bit");
  EXPECT_EQ(range_in_words(bits, {true, false, true, false}), "12 bit, 16 bit");
  EXPECT_EQ(range_in_words(bits, {true, true, true, true}), "any");
  EXPECT_EQ(range_in_words(bits, {false, false, false, false}), "none");
  const std::vector<SummaryBin> words = {{"auto", kNaN}, {"40", 40}};
  EXPECT_EQ(range_in_words(words, {false, true}), "40");
}

SummaryCell cell_with(int a, int b, int within_2) {
  SummaryCell cell;
  cell.a = a;
  cell.b = b;
  cell.runs = cell.model_free.runs = 10;
  cell.model_free.within_2 = cell.model_free.within_5 = within_2;
  return cell;
}

TEST(Words, AnAnswerTellsWhatIsNeededOverTwoAxes) {
  CampaignSummary s;
  s.reference = false;
  s.axes = {{"simulation.rate",
             "sampling rate",
             {{"1 kHz", 1000}, {"2 kHz", 2000}, {"5 kHz", 5000}, {"10 kHz", 10000}}},
            {"encoder.bits", "resolution", {{"14 bit", 14}, {"16 bit", 16}}}};
  SummaryTable pair{0, 1, {}};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 2; ++b) pair.cells.push_back(cell_with(a, b, a >= 2 || (a == 1 && b == 1) ? 9 : 8));
  s.pairs = {pair};
  const auto all = answers(s);
  ASSERT_EQ(all.size(), 3u);  // three tolerances
  EXPECT_EQ(all[0].needs, "nothing in this campaign is enough");
  EXPECT_EQ(all[1].tolerance, 0.02);
  EXPECT_EQ(all[1].parameters, "resolution by sampling rate");
  EXPECT_EQ(all[1].needs, "16 bit with 2 kHz; every resolution that was tried with at least 5 kHz");
}

TEST(Words, AxesAreCalledAsPeopleCallThem) {
  EXPECT_EQ(axis_name("simulation.rate", {}).name, "sampling rate");
  EXPECT_EQ(axis_name("simulation.model.parameters.gap", {}).name, "gap");
  EXPECT_EQ(axis_name("model.parameters.contact_stiffness.value", {}).name, "model's contact stiffness");
  EXPECT_EQ(axis_name("model.parameters.contact_stiffness", {}).unit, "N·m/rad");
  EXPECT_EQ(axis_name("model.parameters.contact_stiffness", Coordinates::kTranslation).unit, "N/m");
  EXPECT_EQ(axis_name("simulation.model.effects.0.contact_adhesion.release_nm", {}).name,
            "contact adhesion: release");
  EXPECT_EQ(axis_name("simulation.model.effects.0.contact_adhesion.release_nm", {}).unit, "N·m");
  EXPECT_EQ(axis_name("some.other.path", {}).name, "some.other.path");
}

TEST(Words, NumbersTakeThePrefixThatKeepsThemShort) {
  EXPECT_EQ(with_unit(2000.0, "Hz"), "2 kHz");
  EXPECT_EQ(with_unit(1000.0, "Hz"), "1 kHz");
  EXPECT_EQ(with_unit(250.0, "Hz"), "250 Hz");
  EXPECT_EQ(with_unit(0.019, "rad"), "19 mrad");
  EXPECT_EQ(with_unit(0.001, "rad"), "1 mrad");
  EXPECT_EQ(with_unit(2e-6, "rad"), "2 µrad");
  EXPECT_EQ(with_unit(0.3, ""), "0.3");
  EXPECT_EQ(with_unit(5000.0, "N·m/rad"), "5000 N·m/rad");
  EXPECT_EQ(with_unit(0.0, "rad"), "0 rad");
}

TEST(Summary, ComparesAlongEveryAxisAndEveryPairButRepeats) {
  const SmallCampaign small(
      "axes: {encoder.bits: [12, 20], simulation.rate: [500, 1000], simulation.seed: {repeat: 2}}\n"
      "drawn: {simulation.initial.x1: {uniform: [0, 0.006]}}\n");
  small.run("store", 2);
  const CampaignSummary s = summarise(CampaignStore(small.place("store")));
  EXPECT_EQ(s.done, 8);
  ASSERT_EQ(s.axes.size(), 2u);
  ASSERT_EQ(s.lines.size(), 2u);
  ASSERT_EQ(s.pairs.size(), 1u);
  EXPECT_EQ(s.axes[s.pairs[0].a].name,
            "sampling rate");  // sampling × resolution, whatever the order of the axes
  EXPECT_EQ(s.axes[s.pairs[0].b].name, "resolution");
  ASSERT_EQ(s.pairs[0].cells.size(), 4u);
  for (const SummaryCell& cell : s.pairs[0].cells) EXPECT_EQ(cell.runs, 2);
  int refused = 0;
  for (const SummaryCount& c : s.refusals) refused += c.runs;
  EXPECT_EQ(refused, s.total.model_free.runs - s.total.model_free.answered);
}

TEST(Summary, ReasonsWithTheSameCodesAreOneWhateverTheirNumbers) {
  const SmallCampaign small("axes: {encoder.bits: [14, 16, 18, 20, 22]}\nestimators: [model_free]\n");
  {
    CampaignStore store(small.place("store"), campaign_header(small.config, {}));
    const auto add = [&](std::uint64_t run, const char* bits, const char* codes, const char* reason) {
      CampaignRow row;
      row.run = run;
      row.point = {bits};
      row.model_free.outcome = "inconclusive";
      row.model_free.reason_codes = codes;
      row.model_free.reason = reason;
      store.add(row, {});
    };
    add(0, "14", "play/level", "play: 0.1 rad at 2 loops");
    add(1, "16", "play/level", "play: 0.2 rad at 3 loops, 0.3 rad at 4 loops");
    add(2, "18", "", "the play is 0.1 rad");
    add(3, "20", "", "the play is 0.2 rad");
    add(4, "22", "too_slow", "too slow");
  }
  const CampaignSummary s = summarise(CampaignStore(small.place("store")));
  ASSERT_EQ(s.refusals.size(), 3u);
  EXPECT_EQ(s.refusals[0].text, "inconclusive: play: # rad at # loops");
  EXPECT_EQ(s.refusals[0].runs, 2);
  EXPECT_EQ(s.refusals[1].text, "inconclusive: the play is # rad")
      << "a reason without codes goes by its words";
  EXPECT_EQ(s.refusals[1].runs, 2);
  EXPECT_EQ(s.refusals[2].runs, 1);
}

TEST(Summary, ARangeWithoutValuesIsCutIntoParts) {
  const SmallCampaign small(
      "sampling: {latin_hypercube: {samples: 12, seed: 1}}\n"
      "axes: {simulation.model.parameters.gap: {log_range: [0.005, 0.05]}}\nestimators: [model_free]\n");
  small.run("store", 2);
  const CampaignSummary s = summarise(CampaignStore(small.place("store")));
  ASSERT_EQ(s.axes[0].bins.size(), 6u);
  ASSERT_EQ(s.lines[0].cells.size(), 6u);
  for (const SummaryCell& cell : s.lines[0].cells) EXPECT_EQ(cell.runs, 2);
}

TEST(Summary, SeedsThatChangeNothingAreCountedOnce) {
  const SmallCampaign small(
      "axes: {simulation.noise: [0, 1.0e-5], simulation.seed: {repeat: 3}}\nestimators: [model_free]\n");
  small.run("store", 2);
  const CampaignSummary s = summarise(CampaignStore(small.place("store")));
  EXPECT_EQ(s.done, 6);
  EXPECT_EQ(s.repeated, 2);
  ASSERT_EQ(s.lines[0].cells.size(), 2u);
  EXPECT_EQ(s.lines[0].cells[0].runs, 1);
  EXPECT_EQ(s.lines[0].cells[1].runs, 3);
}

TEST(Summary, TellsWhatEachEstimatorWasTold) {
  const SmallCampaign small("axes: {encoder.bits: [20], detector.literal: [4]}\n");
  small.run("store", 1);
  const CampaignSummary s = summarise(CampaignStore(small.place("store")));
  EXPECT_TRUE(s.literal);
  ASSERT_EQ(s.told.size(), 3u);
  EXPECT_THAT(s.told[0].told, ::testing::ElementsAre("L = 4 rad/s^2"));
  EXPECT_TRUE(s.told[1].told.empty());
  ASSERT_EQ(s.told[2].told.size(), 1u);
  EXPECT_THAT(s.told[2].told[0], ::testing::HasSubstr("motor_inertia, torque_constant"));
  EXPECT_TRUE(s.told[2].lacks.empty());
  EXPECT_EQ(s.total.literal.passes, 1.0);
  EXPECT_GT(s.total.reference.passes, s.total.model_free.passes);
}

}  // namespace
}  // namespace gapscope
