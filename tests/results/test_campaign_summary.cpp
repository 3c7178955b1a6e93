#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gapscope/base/errors.h"
#include "results/campaign_summary.h"
#include "results/scratch_folder.h"

namespace gapscope {
namespace {

CampaignSummary sample_campaign() {
  CampaignSummary s;
  s.name = "sample";
  s.version = "1.2.3";
  s.configuration = "axis encoder.bits: 12, auto\n";
  s.runs = s.done = 4;
  s.axes = {{"encoder.bits", "resolution", {{"12 bit", 12.0}, {"auto", kNaN}}}};
  SummaryCell cell;
  cell.a = 1;
  cell.runs = 4;
  cell.model_free.answered = 2;
  cell.model_free.median_error = 0.1 + 0.2;
  cell.both = 2;
  s.lines = {{0, -1, {cell}}};
  s.answers = {{0.02, "model_free", "resolution", "at least 16 bit"}};
  s.refusals = {{"inconclusive: too coarse", 2}};
  return s;
}

TEST(CampaignSummary, IsReadBackAsItWasWritten) {
  const ScratchFolder folder;
  write_campaign_summary(folder.path.string(), sample_campaign());
  const CampaignSummary s = read_campaign_summary(folder.path.string());
  EXPECT_EQ(s.name, "sample");
  EXPECT_EQ(s.configuration, "axis encoder.bits: 12, auto\n");
  EXPECT_EQ(s.axes[0].bins[0].value, 12.0);
  EXPECT_TRUE(std::isnan(s.axes[0].bins[1].value));
  EXPECT_EQ(s.lines[0].b, -1);
  EXPECT_EQ(s.lines[0].cells[0].model_free.median_error, 0.1 + 0.2);
  EXPECT_TRUE(std::isnan(s.lines[0].cells[0].reference.bias));
  EXPECT_EQ(s.answers[0].needs, "at least 16 bit");
  EXPECT_EQ(s.refusals[0].runs, 2);
  EXPECT_TRUE(s.pairs.empty());
}

TEST(CampaignSummary, TimesStandBesideIt) {
  const ScratchFolder folder;
  write_campaign_times(folder.path.string(), {0.01, 0.3, 2.0});
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder.path / "timing.json"))["reference_s"], 2.0);
}

TEST(CampaignSummary, AnotherSchemaIsRefused) {
  const ScratchFolder folder;
  EXPECT_FALSE(has_campaign_summary(folder.path.string()));
  std::ofstream(folder.path / "campaign.json") << R"({"schema": "gapscope.campaign/9"})";
  EXPECT_TRUE(has_campaign_summary(folder.path.string()));
  try {
    read_campaign_summary(folder.path.string());
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("expected \"gapscope.campaign/2\""));
  }
}

}  // namespace
}  // namespace gapscope
