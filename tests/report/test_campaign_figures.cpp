#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/campaign_figures.h"
#include "report/clear_texts.h"
#include "report/draw_figure.h"
#include "support/told.h"

namespace gapscope::internal::report {
namespace {

using ::testing::HasSubstr;
using testing::line_with;

EstimatorScore score(int answered, double error) {
  EstimatorScore e;
  e.runs = 20;
  e.answered = e.judged = answered;
  e.claimed = answered;
  e.covered = answered * 9 / 10;
  e.passes = 24.0;
  if (answered == 0) return e;
  e.median_error = error;
  e.error_90 = 3.0 * error;
  e.bias = -error;
  e.bias_ci = {-2.0 * error, 0.5 * error};
  e.median_width = 4.0 * error;
  e.interval_score = 6.0 * error;
  e.within_2 = error < 0.02 ? answered : 0;
  return e;
}

SummaryCell cell(int a, int b) {
  SummaryCell c;
  c.a = a;
  c.b = b;
  c.runs = 20;
  c.literal = score(a > 2 ? 8 : 0, 0.04);
  c.literal.claimed = c.literal.covered = 0;
  c.literal.median_width = c.literal.interval_score = kNaN;
  c.model_free = score(a == 0 ? 0 : 10 + 2 * a, 0.05 / (a + 1));
  c.reference = score(20, 1e-6 * (std::max(b, 0) + 1));
  c.both = a == 0 ? 0 : 10;
  c.disagree = a;
  return c;
}

/// Five rates and eight resolutions; nothing of the model-free detector at the lowest rate.
CampaignSummary sample_campaign() {
  CampaignSummary s;
  s.name = "sample_of_a_campaign";
  s.version = "1.2.3";
  s.runs = s.done = 800;
  s.samples = 10000.0;
  s.recorded = 4.0;
  s.axes = {{"simulation.rate", "sampling rate", {}}, {"encoder.bits", "resolution", {}}};
  for (const char* label : {"250 Hz", "500 Hz", "1 kHz", "2 kHz", "5 kHz"})
    s.axes[0].bins.push_back({label, 1.0});
  for (const char* label : {"10 bit", "12 bit", "13 bit", "14 bit", "15 bit", "16 bit", "18 bit", "20 bit"})
    s.axes[1].bins.push_back({label, 1.0});
  s.total = cell(2, 0);
  s.lines = {{0, -1, {}}, {1, -1, {}}};
  s.pairs = {{0, 1, {}}};
  for (int a = 0; a < 5; ++a) s.lines[0].cells.push_back(cell(a, -1));
  for (int b = 0; b < 8; ++b) s.lines[1].cells.push_back(cell(b, -1));
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 8; ++b) s.pairs[0].cells.push_back(cell(a, b));
  s.answers = {{0.02, "model_free", "resolution by sampling rate", "at least 16 bit with 2 kHz"}};
  s.refusals = {{"inconclusive: too coarse", 8}};
  return s;
}

TEST(CampaignFigures, HaveNoTextsThatMeetOrAreCut) {
  for (const int estimators : {3, 1}) {
    CampaignSummary s = sample_campaign();
    s.literal = estimators > 2;
    s.model_free = estimators > 1;
    for (const FigureData& figure : campaign_figures(s)) {
      const Drawing drawing = draw_with_notes(figure);
      expect_clear_texts(figure, drawing);
    }
  }
}

TEST(CampaignFigures, AMapHasATileForEverySettingDarkWhereItIsBad) {
  const CampaignSummary s = sample_campaign();
  const FigureData map = campaign_map(s, s.pairs[0]);
  ASSERT_EQ(map.panels.size(), 10u);
  for (const Panel& panel : map.panels) EXPECT_EQ(panel.tiles.size(), 40u);
  const auto& refusals = map.panels[2].tiles;
  EXPECT_EQ(refusals.front().note, "n 20") << "n in every cell";
  EXPECT_EQ(refusals.front().text, "100");
  EXPECT_EQ(refusals.back().text, "10");
  EXPECT_LT(refusals.front().colour.red, refusals.back().colour.red);
  EXPECT_EQ(map.panels[0].tiles.front().text, "–");
}

TEST(CampaignFigures, ALineHasAPointForEveryValueOfBothEstimators) {
  const CampaignSummary s = sample_campaign();
  const FigureData line = campaign_line(s, s.lines[0]);
  ASSERT_EQ(line.panels.size(), 6u);
  for (const Panel& panel : line.panels) {
    EXPECT_EQ(panel.x.places.size(), 5u);
    for (const Series& series : panel.series) EXPECT_EQ(series.y.size(), 5u);
  }
  EXPECT_THAT(line.reading, HasSubstr("at 5 kHz"));
}

TEST(CampaignText, SaysWhatIsNeededAndWhyThereWasNoAnswer) {
  const CampaignSummary s = sample_campaign();
  const std::string text = campaign_text(s, campaign_figures(s));
  EXPECT_TOLD(line_with(text, "| 2 % |"));
  EXPECT_TOLD(line_with(text, "- 8 runs: inconclusive:"));
  EXPECT_THAT(text, HasSubstr("(map_1_2.png)"));
}

TEST(CampaignText, ItsFirstLinesSayWhichEstimatorToTakeWhenAndWhatItCosts) {
  CampaignSummary s = sample_campaign();
  s.literal = true;
  s.told = {{"literal", {"L = 6 rad/s^2"}, {}}, {"model_free", {}, {}}, {"reference", {"motor_inertia"}, {}}};
  s.total.reference.within_5 = 19;
  s.total.model_free.within_5 = 12;
  s.pairs[0].cells[3].model_free.within_5 = 3;
  const std::vector<std::string> lines = campaign_verdict(s);
  ASSERT_EQ(lines.size(), 3u);
  for (const std::string& line : lines) EXPECT_TOLD(line);
  EXPECT_THAT(campaign_text(s, {}),
              HasSubstr("\n\n- " + lines[0] + "\n- " + lines[1] + "\n- " + lines[2] + "\n\n"));
}

TEST(CampaignText, SharesAreShort) {
  EXPECT_EQ(percent(0.5), "50 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(-0.00123), "-0.12 %");
  EXPECT_EQ(percent(1e-7), "< 0.001 %");
  EXPECT_EQ(percent(0.0), "0 %");
  EXPECT_EQ(percent(kNaN), "–");
}

}  // namespace
}  // namespace gapscope::internal::report
