#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "campaign/small_campaign.h"
#include "campaign/store.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "run/run_pipeline.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::SmallCampaign;

const std::string kStoredAxes =
    "axes: {encoder.bits: [16, 20], detector.bound: [auto, 40, {from_model: {input_limit: 1, "
    "load_force_bound: 0}}]}\n";

/// Why the store in its place is refused to a campaign.
std::string refusal(const SmallCampaign& small, const CampaignHeader& header) {
  try {
    const CampaignStore store(small.place("store"), header);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST(Store, GivesBackWhatWasAdded) {
  const SmallCampaign small(kStoredAxes);
  CampaignRow row;
  row.run = 2;
  row.point = {"16", "{from_model: {input_limit: 1, load_force_bound: 0}}"};
  row.configuration = "name: a\n";
  row.model_free.reason = "said \"no\", twice\nor more";
  row.model_free.gap = 0.1 + 0.2;
  row.reference.ci95 = {1e-3, 2e-3};
  row.agree = false;
  CampaignStore store(small.place("store"), campaign_header(small.config, {}));
  store.add(row, {.model_free_s = 0.5, .run_s = 1.0});
  EXPECT_THAT(store.done(), ::testing::ElementsAre(2u));
  const CampaignStore reader(small.place("store"));
  int seen = 0;
  reader.each(
      [&](CampaignRow& r, CampaignTiming& t) {
        ++seen;
        EXPECT_EQ(r.run, 2u);
        EXPECT_EQ(r.point, row.point);
        EXPECT_EQ(r.configuration, row.configuration);
        EXPECT_EQ(r.model_free.reason, row.model_free.reason);
        EXPECT_EQ(r.model_free.gap, row.model_free.gap);
        EXPECT_TRUE(std::isnan(r.model_free.std));
        EXPECT_EQ(r.reference.ci95.high, 2e-3);
        EXPECT_EQ(r.agree, false);
        EXPECT_EQ(t.model_free_s, 0.5);
        EXPECT_TRUE(std::isnan(t.reference_s));
      },
      true);
  EXPECT_EQ(seen, 1);
}

TEST(Store, KnowsWhatItIsAStoreOf) {
  const SmallCampaign small(kStoredAxes);
  { const CampaignStore made(small.place("store"), campaign_header(small.config, {2, 3})); }
  const CampaignHeader h = CampaignStore(small.place("store")).header();
  EXPECT_EQ(h.name, "small");
  EXPECT_EQ(h.runs, 6u);
  EXPECT_EQ(to_string(h.shard), "2/3");
  ASSERT_EQ(h.axes.size(), 2u);
  EXPECT_EQ(h.axes[0].path, "encoder.bits");
  EXPECT_EQ(h.axes[0].values[1].number, 20.0);
  EXPECT_EQ(h.axes[1].values[2].yaml, small.config.axes[1].values[2].yaml);
}

TEST(Store, ACellOfTheExportThatNeedsQuotesHasThem) {
  const SmallCampaign small(kStoredAxes);
  CampaignStore store(small.place("store"), campaign_header(small.config, {}));
  CampaignRow row;
  row.point = {"16", "auto"};
  row.error = "a \"b\", c";
  store.add(row, {});
  EXPECT_THAT(SmallCampaign::exported(store), HasSubstr("\n1,16,auto,,\"a \"\"b\"\", c\","));
}

TEST(Store, AnotherCampaignIsRefusedWithTheDifferenceNamed) {
  const SmallCampaign small(kStoredAxes), other("axes: {encoder.bits: [16, 18]}\n");
  { const CampaignStore made(small.place("store"), campaign_header(small.config, {})); }
  EXPECT_THAT(refusal(small, campaign_header(other.config, {})),
              AllOf(HasSubstr("results.sqlite: belongs to another campaign"),
                    HasSubstr("'axis encoder.bits: 16, 20', expected 'axis encoder.bits: 16, 18'")));
}

TEST(Store, AChangeOfTheBaseIsAnotherCampaign) {
  const SmallCampaign small(kStoredAxes);
  { const CampaignStore made(small.place("store"), campaign_header(small.config, {})); }
  CampaignConfig changed = small.config;
  changed.base_text.replace(changed.base_text.find("duration: 2"), 11, "duration: 3");
  EXPECT_THAT(refusal(small, campaign_header(changed, {})),
              HasSubstr("it has 'duration: 2  # s', expected 'duration: 3  # s'"));
}

/// A campaign over two recordings of the same rig.
class RecordedCampaign {
 public:
  RecordedCampaign() : rig_("axes: {simulation.seed: [1, 2]}\n") {
    for (const int k : {0, 1}) record(k, 1.0);
    std::ofstream(rig_.folder.path / "recorded.yaml")
        << "name: recorded\nestimators: [model_free]\naxes: {recording.file: [r0.csv, r1.csv]}\n"
           "base: {recording: {file: r0.csv}, encoder: {bits: 18}}\n";
  }
  /// @param factor  of the position
  void record(int k, double factor) const {
    Recording r = simulated_recording(campaign_run(rig_.config, static_cast<std::uint64_t>(k)));
    for (double& x : r.x1) x *= factor;
    write_csv(rig_.place("r" + std::to_string(k) + ".csv"), r);
  }
  CampaignConfig config() const { return load_campaign(rig_.place("recorded.yaml")); }
  const SmallCampaign& rig() const { return rig_; }

 private:
  SmallCampaign rig_;
};

TEST(Store, RecordedDataMakeACampaignToo) {
  const RecordedCampaign recorded;
  CampaignTiming timing;
  const CampaignRow row = run_of_campaign(recorded.config(), 1, timing);
  EXPECT_EQ(row.error, "");
  EXPECT_EQ(row.point, std::vector<std::string>{"r1.csv"});
  EXPECT_NE(row.model_free.outcome, "");
  EXPECT_TRUE(std::isnan(row.true_gap));
}

TEST(Store, AnotherRecordingUnderTheSameNameIsAnotherCampaign) {
  const RecordedCampaign recorded;
  { const CampaignStore made(recorded.rig().place("store"), campaign_header(recorded.config(), {})); }
  recorded.record(1, 2.0);
  EXPECT_THAT(refusal(recorded.rig(), campaign_header(recorded.config(), {})),
              HasSubstr("it has 'recording r1.csv: "));
}

TEST(Store, AnotherVersionAndAnotherShardAreRefused) {
  const SmallCampaign small(kStoredAxes);
  CampaignHeader header = campaign_header(small.config, {});
  { const CampaignStore made(small.place("store"), header); }
  header.version = "9.9.9";
  EXPECT_THAT(refusal(small, header), HasSubstr("expected 9.9.9"));
  EXPECT_THAT(refusal(small, campaign_header(small.config, {1, 2})),
              HasSubstr("holds shard 1/1, expected 1/2"));
}

TEST(Store, TimesAreExportedWhereTheyAreAskedFor) {
  const SmallCampaign small("axes: {encoder.bits: [16, 20]}\n");
  CampaignStore store(small.place("store"), campaign_header(small.config, {}));
  CampaignRow row;
  row.point = {"16"};
  store.add(row, {.literal_s = 0.25, .run_s = 1.5});
  std::string with;
  export_campaign(store, true, [&](const std::string& part) { with += part; });
  EXPECT_THAT(with, AllOf(HasSubstr(",agree,literal_s,model_free_s,reference_s,run_s\n"),
                          HasSubstr(",0.25,,,1.5\n")));
  EXPECT_THAT(SmallCampaign::exported(store), ::testing::Not(HasSubstr("literal_s,")));
}

TEST(Store, OnlyOneProcessAddsAtATime) {
  const SmallCampaign small(kStoredAxes);
  const CampaignStore first(small.place("store"), campaign_header(small.config, {}));
  EXPECT_THAT(refusal(small, campaign_header(small.config, {})), HasSubstr("another process"));
}

TEST(Store, StoresOfDifferentCampaignsAreNotMerged) {
  const SmallCampaign small(kStoredAxes), other("axes: {encoder.bits: [16, 18]}\n");
  { const CampaignStore a(small.place("a"), campaign_header(small.config, {1, 2})); }
  { const CampaignStore b(small.place("b"), campaign_header(other.config, {2, 2})); }
  EXPECT_THROW(merge_campaigns({small.place("a"), small.place("b")}, small.place("merged")), ConfigError);
  EXPECT_FALSE(std::filesystem::exists(small.place("merged")));
}

TEST(Store, AFolderWithoutAStoreIsTold) {
  const SmallCampaign small(kStoredAxes);
  EXPECT_THROW(CampaignStore{small.place("nowhere")}, ConfigError);
}

}  // namespace
}  // namespace gapscope
