#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/campaign_config.h"
#include "config/campaign_point.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kSimulated;
using testing::TemporaryFile;

/// A campaign over the shortest simulated configuration, which lies beside it.
class Campaign {
 public:
  explicit Campaign(const std::string& text) : place_("base: sim.yaml\n" + text, "c.yaml") {
    std::ofstream(place_.folder() / "sim.yaml") << kSimulated;
  }
  CampaignConfig load() const { return load_campaign(place_.path()); }
  std::string refusal() const {
    try {
      load();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "(accepted)";
  }

 private:
  TemporaryFile place_;
};

std::vector<std::string> texts(const std::vector<AxisValue>& values) {
  std::vector<std::string> out;
  for (const AxisValue& v : values) out.push_back(v.yaml);
  return out;
}

TEST(CampaignConfig, AnEffectGoesByItsNameOrItsPlace) {
  const auto level = [](const std::string& place) {
    const TemporaryFile campaign("base: sim.yaml\naxes: {model.effects." + place +
                                     ".level_nm: [0.02], simulation.seed: {repeat: 2}}\n",
                                 "c.yaml");
    std::ofstream(campaign.folder() / "sim.yaml")
        << kSimulated << "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n";
    return campaign_run(load_campaign(campaign.path()), 0).model.effects.at(0).effect.parameters.at(0).value;
  };
  EXPECT_DOUBLE_EQ(level("motor_coulomb_friction"), 0.02);
  EXPECT_DOUBLE_EQ(level("0.motor_coulomb_friction"), 0.02);
  EXPECT_THROW(level("cogging_torque"), ConfigError);
}

TEST(CampaignConfig, LiteralTwiceIsNoComparison) {
  EXPECT_THAT(
      Campaign(
          "estimators: [literal, model_free]\naxes:\n  detector: [{method: literal, bound: 6, literal: 6}]\n")
          .refusal(),
      HasSubstr("has literal twice"));
}

TEST(CampaignConfig, AxesAreListsRangesRatiosAndSeeds) {
  const CampaignConfig c = Campaign(
                               "axes:\n"
                               "  detector.bound: [auto, 40]\n"
                               "  model.parameters.gap: {range: [0.01, 0.03], count: 3}\n"
                               "  simulation.rate: {log_range: [500, 8000], count: 5}\n"
                               "  simulation.seed: {repeat: 2, seed: 7}\n")
                               .load();
  EXPECT_EQ(c.runs(), 2u * 3u * 5u * 2u);
  EXPECT_THAT(texts(c.axes[0].values), ElementsAre("auto", "40"));
  EXPECT_THAT(texts(c.axes[1].values), ElementsAre("0.01", "0.02", "0.03"));
  EXPECT_THAT(texts(c.axes[2].values), ElementsAre("500", "1000", "2000", "4000", "8000"));
  EXPECT_THAT(texts(c.axes[3].values), ElementsAre("7", "8"));
  EXPECT_TRUE(c.axes[3].repeat);
}

TEST(CampaignConfig, EveryCombinationComesOnceTheLastAxisFastest) {
  const CampaignConfig c =
      Campaign("axes: {model.parameters.gap: [0.01, 0.02], simulation.rate: [1000, 2000, 3000]}").load();
  std::set<std::vector<std::string>> points;
  for (std::uint64_t i = 0; i < c.runs(); ++i) points.insert(texts(campaign_point(c, i)));
  EXPECT_EQ(points.size(), 6u);
  EXPECT_THAT(texts(campaign_point(c, 1)), ElementsAre("0.01", "2000"));
  EXPECT_THAT(texts(campaign_point(c, 3)), ElementsAre("0.02", "1000"));
}

TEST(CampaignConfig, ARunHasTheValuesOfItsPointAndTheRestOfTheBase) {
  const CampaignConfig c =
      Campaign(
          "name: two\naxes: {simulation.model.parameters.gap: [0.01, 0.02], simulation.seed: {repeat: 2}}")
          .load();
  const Configuration run = campaign_run(c, 3);
  EXPECT_EQ(run.name, "two_run_4");
  EXPECT_DOUBLE_EQ(run.simulation->plant.drive.gap, 0.02);
  EXPECT_DOUBLE_EQ(run.model.parameters[drive_parameter_index("gap")].value, 0.02);  // as in the base
  EXPECT_EQ(run.simulation->seed, 2u);
  EXPECT_DOUBLE_EQ(run.simulation->rate, 1000.0);
}

TEST(CampaignConfig, APathLeadsIntoListsAndReplacesWholeParts) {
  const CampaignConfig c = Campaign(
                               "axes:\n"
                               "  simulation.excitation: [{sine: {amplitude: 0.5, frequency: 2}}, {triangle: "
                               "{amplitude: 0.4, frequency: 1}}]\n"
                               "  model.effects: [[], [{motor_coulomb_friction: {level_nm: 0.01}}]]\n")
                               .load();
  EXPECT_EQ(c.axes[0].values[1].yaml, "{triangle: {amplitude: 0.4, frequency: 1}}");
  const Configuration last = campaign_run(c, 3);
  EXPECT_EQ(last.simulation->excitation.kind, ExcitationKind::kTriangle);
  ASSERT_EQ(last.model.effects.size(), 1u);
}

TEST(CampaignConfig, TheBaseCanStandInTheSameFile) {
  std::string indented;
  std::istringstream lines(kSimulated);
  for (std::string line; std::getline(lines, line);) indented += "  " + line + "\n";
  const TemporaryFile file("name: one_file\naxes: {simulation.rate: [1000, 2000]}\nbase:\n" + indented,
                           "c.yaml");
  EXPECT_DOUBLE_EQ(campaign_run(load_campaign(file.path()), 1).simulation->rate, 2000.0);
}

TEST(CampaignConfig, AHypercubeMeetsEveryStratumOfEveryAxisOnce) {
  const CampaignConfig c = Campaign(
                               "sampling: {latin_hypercube: {samples: 60, seed: 3}}\n"
                               "axes:\n"
                               "  model.parameters.gap: {log_range: [0.005, 0.05]}\n"
                               "  simulation.rate: [1000, 2000, 5000]\n")
                               .load();
  ASSERT_EQ(c.runs(), 60u);
  std::vector<double> gaps;
  std::map<std::string, int> rates;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto point = campaign_point(c, i);
    gaps.push_back(point[0].number);
    ++rates[point[1].yaml];
  }
  std::sort(gaps.begin(), gaps.end());
  for (std::size_t k = 0; k < 60; ++k) {
    const double share = std::log10(gaps[k] / 0.005) * 60.0;
    EXPECT_GE(share, static_cast<double>(k) - 1e-6);
    EXPECT_LE(share, static_cast<double>(k) + 1.0 + 1e-6);
  }
  for (const auto& [rate, times] : rates) EXPECT_EQ(times, 20) << rate;
}

TEST(CampaignConfig, ThePermutationOfAHypercubeIsOneForEverySize) {
  for (const std::uint64_t size : {1u, 2u, 3u, 17u, 64u, 1000u}) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < size; ++i) seen.insert(internal::config::permuted(i, size, 99));
    EXPECT_EQ(seen.size(), size);
    EXPECT_EQ(*seen.rbegin(), size - 1);
  }
}

TEST(CampaignConfig, DrawnNumbersDifferFromRunToRunAndAddNone) {
  const CampaignConfig c = Campaign(
                               "axes: {simulation.seed: {repeat: 40}}\n"
                               "drawn: {simulation.initial.x1: {uniform: [0, 0.001]}}\n")
                               .load();
  EXPECT_EQ(c.runs(), 40u);
  std::set<double> seen;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const double x1 = campaign_run(c, i).simulation->initial.x1;
    EXPECT_GE(x1, 0.0);
    EXPECT_LE(x1, 0.001);
    seen.insert(x1);
  }
  EXPECT_EQ(seen.size(), 40u);
}

TEST(CampaignConfig, AGridOfATrillionRunsIsRefusedWithItsNumber) {
  EXPECT_THAT(Campaign("axes:\n  model.parameters.gap: {range: [0.01, 0.02], count: 1000000}\n"
                       "  simulation.seed: {repeat: 1000000}\n")
                  .refusal(),
              HasSubstr("c.yaml:2: axes give 1000000000000 runs, expected at most 10000000"));
}

TEST(CampaignConfig, WhatDecidesTheResultsIsItsIdentity) {
  const std::string axes = "axes: {simulation.rate: [1000, 2000]}\n";
  const std::string identity = campaign_identity(Campaign(axes).load());
  EXPECT_EQ(identity, campaign_identity(Campaign("# a remark\nname: renamed\n" + axes).load()));
  EXPECT_NE(identity, campaign_identity(Campaign("axes: {simulation.rate: [1000, 2500]}\n").load()));
  EXPECT_NE(identity, campaign_identity(Campaign(axes + "estimators: [reference]\n").load()));
}

struct BadCampaign {
  const char* name;
  std::string text;
  std::string message;
};
void PrintTo(const BadCampaign& bad, std::ostream* out) { *out << bad.name; }

class BadCampaignTest : public ::testing::TestWithParam<BadCampaign> {};

TEST_P(BadCampaignTest, IsRefusedWithPlaceAndExpectation) {
  const std::string message = Campaign(GetParam().text).refusal();
  EXPECT_THAT(message, HasSubstr(GetParam().message));
  EXPECT_THAT(message, HasSubstr("expected"));
}

INSTANTIATE_TEST_SUITE_P(
    Campaigns, BadCampaignTest,
    ::testing::Values(
        BadCampaign{"no_axes", "name: a\n", "c.yaml:1: there is no axes"},
        BadCampaign{"empty_axes", "axes: {}\n", "c.yaml:2: axes is an empty map"},
        BadCampaign{"empty_list", "axes:\n  simulation.rate: []\n",
                    "c.yaml:3: axes.simulation.rate is an empty list"},
        BadCampaign{"scalar", "axes:\n  simulation.rate: 5\n", "c.yaml:3: axes.simulation.rate is '5'"},
        BadCampaign{"two_kinds", "axes:\n  simulation.rate: {range: [1, 2], repeat: 3}\n",
                    "not exactly one of"},
        BadCampaign{"no_count", "axes:\n  simulation.rate: {range: [1000, 2000]}\n", "has no count"},
        BadCampaign{"count_of_one", "axes:\n  simulation.rate: {range: [1000, 2000], count: 1}\n", "is 1"},
        BadCampaign{"falling", "axes:\n  simulation.rate: {range: [2000, 1000], count: 3}\n", "low < high"},
        BadCampaign{"log_of_zero", "axes:\n  simulation.rate: {log_range: [0, 1000], count: 3}\n",
                    "c.yaml:3"},
        BadCampaign{"unknown_path", "axes:\n  encoder.bits: [16]\n  simulation.rat: [1000]\n",
                    "c.yaml:4: the first run cannot be made"},
        BadCampaign{"value_of_another_kind", "axes:\n  simulation.rate: [fast]\n",
                    "simulation.rate is 'fast'"},
        BadCampaign{"through_a_number", "axes:\n  simulation.rate.hz: [1000]\n", "no map that holds 'hz'"},
        BadCampaign{"alias_of_itself", "axes:\n  simulation.rate: &a [*a]\n",
                    "c.yaml:3: an alias stands within what it stands for"},
        BadCampaign{"long_path", "axes:\n  encoder" + std::string(300, '.') + ": [1]\n",
                    "c.yaml:3: the path encoder" + std::string(36, '.') + " has 307 characters"},
        BadCampaign{"same_place", "axes:\n  simulation: [1]\n  simulation.rate: [1000]\n", "c.yaml:4"},
        BadCampaign{"unknown_estimator", "axes:\n  simulation.rate: [1000]\nestimators: [kalman]\n",
                    "'kalman'"},
        BadCampaign{
            "endless_axis",
            "sampling: {latin_hypercube: {samples: 4}}\naxes:\n  simulation.rate: {range: [1000, 2000], "
            "count: 1000000000000}\n",
            "c.yaml:4: simulation.rate brings the values of all axes to 1000000000000, expected at most 10000000"},
        BadCampaign{"no_samples",
                    "axes:\n  simulation.rate: [1000]\nsampling: {latin_hypercube: {seed: 1}}\n",
                    "has no samples"},
        BadCampaign{"other_sampling", "axes:\n  simulation.rate: [1000]\nsampling: sobol\n",
                    "sampling is 'sobol'"}),
    [](const auto& campaign) { return campaign.param.name; });

TEST(CampaignConfig, EveryCampaignOfTheRepositoryLoads) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GAPSCOPE_CONFIGS)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".yaml" || !name.ends_with("_campaign")) continue;
    ++count;
    CampaignConfig c;
    ASSERT_NO_THROW(c = load_campaign(entry.path().string())) << entry.path();
    EXPECT_EQ(c.name + "_campaign", name);
    for (std::uint64_t run = 0; run < c.runs(); run += std::max<std::uint64_t>(1, c.runs() / 50))
      EXPECT_NO_THROW(campaign_run(c, run)) << entry.path() << " run " << run;
  }
  EXPECT_GT(count, 0);
}

TEST(CampaignConfig, AMissingBaseIsToldAtItsPlace) {
  const TemporaryFile file("name: a\nbase: nowhere.yaml\naxes: {simulation.rate: [1]}\n", "c.yaml");
  try {
    load_campaign(file.path());
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("c.yaml:2: base names nowhere.yaml"));
  }
}

}  // namespace
}  // namespace gapscope
