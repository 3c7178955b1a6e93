#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "campaign/small_campaign.h"
#include "gapscope/base/errors.h"
#include "run/run_pipeline.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::SmallCampaign;

const std::string kAxes =
    "axes: {encoder.bits: [12, 16, 20], simulation.seed: {repeat: 3}}\n"
    "drawn: {simulation.initial.x1: {uniform: [0, 0.006]}}\n";

TEST(Runner, AnyNumberOfThreadsGivesTheSameBytes) {
  const SmallCampaign small(kAxes);
  const std::string one = small.run("one", 1);
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1 + 9);
  EXPECT_EQ(one, small.run("three", 3));
}

TEST(Runner, ARowIsWhatTheCommandGivesForItsResolvedConfiguration) {
  const SmallCampaign small(kAxes);
  CampaignTiming timing;
  const CampaignRow row = run_of_campaign(small.config, 8, timing);
  EXPECT_EQ(row.error, "");
  EXPECT_EQ(row.seed, "3");
  const RunOutcome again =
      run_pipeline(parse_configuration(row.configuration, "resolved.yaml"), {}, [](const std::string&) {});
  EXPECT_EQ(row.reference.gap, again.result.reference->find("gap")->value);
  EXPECT_EQ(row.model_free.outcome, to_string(again.result.model_free->verdict));
  EXPECT_EQ(row.true_gap, 0.019);
  EXPECT_GT(timing.run_s, 0.0);
}

TEST(Runner, ARunThatFailsIsARowWithItsError) {
  const SmallCampaign small("axes: {simulation.excitation.sine.frequency: [1, 5000, 2]}\n");
  const std::string table = small.run("store", 2);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3);
  EXPECT_THAT(table, HasSubstr("base.yaml:"));
  EXPECT_THAT(table, ::testing::Not(HasSubstr(small.folder.path.string())));
  CampaignStore(small.place("store")).each([](CampaignRow& row, CampaignTiming&) {
    EXPECT_EQ(row.error.empty(), row.run != 1) << row.error;
    EXPECT_EQ(std::isnan(row.reference.gap), row.run == 1);
  });
}

TEST(Runner, TheIndependentPlantMakesTheSameDriveByOtherCode) {
  const SmallCampaign small("axes: {simulation.plant: [simulator, independent], simulation.noise: [0]}\n");
  const Recording own = simulated_recording(campaign_run(small.config, 0));
  const Recording independent = simulated_recording(campaign_run(small.config, 1));
  ASSERT_EQ(own.size(), independent.size());
  for (std::size_t i = 0; i < own.size(); ++i)  // a count at most, where a position lies between two
    EXPECT_NEAR(own.x1[i], independent.x1[i], 1.01 * own.quantum) << i;
  EXPECT_EQ(independent.u, own.u);
}

TEST(Runner, OnlyTheEstimatorsThatWereAskedForAreRun) {
  const SmallCampaign small("axes: {encoder.bits: [20]}\nestimators: [model_free]\n");
  CampaignTiming timing;
  const CampaignRow row = run_of_campaign(small.config, 0, timing);
  EXPECT_NE(row.model_free.outcome, "");
  EXPECT_EQ(row.reference.outcome, "");
  EXPECT_TRUE(std::isnan(timing.reference_s));
}

TEST(Runner, AStoppedCampaignGoesOnWhereItWas) {
  const SmallCampaign small(kAxes);
  const std::string whole = small.run("whole", 1);
  {
    CampaignStore store(small.place("stopped"), campaign_header(small.config, {}));
    EXPECT_THROW(run_campaign(small.config, store, 2,
                              [](const CampaignProgress& p) {
                                if (p.fresh == 4) request_stop();
                              }),
                 Interrupted);
    clear_stop_request();
    EXPECT_GE(store.done().size(), 4u);
    EXPECT_LT(store.done().size(), 9u);
  }
  CampaignStore store(small.place("stopped"), campaign_header(small.config, {}));
  const auto before = store.done().size();
  const CampaignProgress p = run_campaign(small.config, store, 2, [](const CampaignProgress&) {});
  EXPECT_EQ(p.fresh, 9 - before);
  EXPECT_EQ(SmallCampaign::exported(store), whole);
}

TEST(Runner, ShardsAreDisjointAndCompleteAndMergeIntoTheWhole) {
  const SmallCampaign small(kAxes);
  for (const int k : {1, 2, 3}) small.run("shard" + std::to_string(k), 1, {static_cast<std::uint64_t>(k), 3});
  EXPECT_EQ(merge_campaigns({small.place("shard3"), small.place("shard1"), small.place("shard2")},
                            small.place("merged")),
            9u);
  EXPECT_EQ(SmallCampaign::exported(CampaignStore(small.place("merged"))), small.run("whole", 2));
}

TEST(Runner, ARowThatTwoStoresHaveMustBeTheSameInBoth) {
  const SmallCampaign small("axes: {encoder.bits: [16, 20]}\n");
  for (const int k : {1, 2}) small.run("shard" + std::to_string(k), 1, {static_cast<std::uint64_t>(k), 2});
  CampaignRow other;
  other.run = 0;  // of the first shard
  other.point = {"16"};
  other.model_free.gap = 0.5;
  CampaignStore(small.place("shard2"), campaign_header(small.config, {2, 2})).add(other, {});
  EXPECT_THROW(merge_campaigns({small.place("shard1"), small.place("shard2")}, small.place("merged")),
               ConfigError);
}

TEST(Runner, TheSizeOfAShardIsTheNumberOfItsRuns) {
  for (const std::uint64_t of : {1u, 2u, 3u, 7u, 20u})
    for (std::uint64_t k = 1; k <= of; ++k) {
      std::uint64_t counted = 0;
      for (std::uint64_t i = 0; i < 16; ++i) counted += CampaignShard{k, of}.holds(i) ? 1 : 0;
      EXPECT_EQ((CampaignShard{k, of}.size(16)), counted);
    }
}

TEST(Runner, AForecastMeasuresRunsFromAllOverTheCampaign) {
  const SmallCampaign small(kAxes);
  const CampaignForecast f = forecast(small.config, {}, 1);
  EXPECT_EQ(f.measured, 8);
  EXPECT_NEAR(f.total_s, 9.0 * f.run_s, 1e-9);
}

TEST(Runner, WhatTheMachineFailsAtIsNoResult) {
  const SmallCampaign simulated("axes: {simulation.seed: [1]}\n");
  std::ofstream(simulated.place("d.csv")) << "t,u,x1\n";
  std::ofstream(simulated.place("recorded.yaml")) << "name: r\nbase: {recording: {file: d.csv}}\naxes: "
                                                     "{encoder.bits: [16, 18]}\nestimators: [model_free]\n";
  const CampaignConfig recorded = load_campaign(simulated.place("recorded.yaml"));
  CampaignTiming timing;
  EXPECT_NE(run_of_campaign(recorded, 0, timing).error, "") << "a recording of no row";
  rlimit handles{};
  getrlimit(RLIMIT_NOFILE, &handles);
  const rlimit none{0, handles.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  EXPECT_THROW(run_of_campaign(recorded, 0, timing), MachineError);
  setrlimit(RLIMIT_NOFILE, &handles);
}

}  // namespace
}  // namespace gapscope
