// The same input, seed and version give the same bytes, and every result says what it was made from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using testing::stored;
using testing::text_of;
using testing::Workplace;

const std::string kModelPart = "model: " + testing::kPaperModel;

// The paper's rig for two seconds, and a friction that its model lacks.
const std::string kUnlikeItsModel =
    "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 2, seed: 3, "
    "excitation: {sine: {amplitude: 0.58, frequency: 1}}, "
    "model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}}\n" +
    kModelPart;
const std::string kManyDrives =
    "name: many\naxes: {encoder.bits: [14, 18], simulation.seed: {repeat: 3}}\nbase:\n  encoder: {bits: 18}\n"
    "  simulation: {rate: 1000, duration: 2, noise: 1.0e-5, "
    "excitation: {sine: {amplitude: 0.58, frequency: 1}}}\n  " +
    kModelPart;
const std::string kThreeCases =
    "name: check\nreport: {first_seed: 9300001, none: 3}\nrigs: [geared]\nduration: 2\n";

json read(const Workplace& place, const std::string& file) {
  return json::parse(text_of(place.folder() / file));
}

/// What `sha256sum` says of a file of the place.
std::string sha256sum(const Workplace& place, const std::string& file) {
  const std::string said = (place.folder() / "sum").string();
  EXPECT_EQ(std::system(("cd " + place.folder().string() + " && sha256sum " + file + " >" + said).c_str()),
            0);
  return text_of(said).substr(0, 64);
}

class SameAnswer : public ::testing::TestWithParam<const char*> {};

TEST_P(SameAnswer, ForOneAndFiveThreadsInAnyFolder) {
  std::string first;
  for (const char* threads : {"1", "5"}) {
    Workplace place;
    place.file("c.yaml", kUnlikeItsModel);
    place.file("campaign.yaml", kManyDrives);
    place.file("check.yaml", kThreeCases);
    const bool diagnoses = std::string(GetParam()).starts_with("diagnose");
    const std::string few =
        diagnoses ? testing::excluding_all_but({"motor_coulomb_friction", "friction_asymmetry",
                                                "cogging_torque", "quadratic_drag", "input_delay"})
                  : "";
    const auto done = place.run(std::string(GetParam()) + " -o out -j " + threads + few);
    ASSERT_EQ(done.status, 0) << done.err;
    const std::string all = stored(place.folder() / "out");
    EXPECT_THAT(all, HasSubstr("report.md\n"));
    if (first.empty()) first = all;
    EXPECT_TRUE(all == first) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, SameAnswer,
                         ::testing::Values("diagnose c.yaml", "campaign campaign.yaml",
                                           "blind run check.yaml"),
                         [](const auto& tested) {
                           const std::string command = tested.param;
                           return command.substr(0, command.find(' '));
                         });

TEST(SameAnswerOf, ARecordingThatLiesInAnotherFolder) {
  std::string first;
  for (const char* folder : {"here/", "there/below/"}) {
    Workplace place;
    place.file("c.yaml", kUnlikeItsModel);
    place.file(folder + std::string("r.yaml"),
               "recording: {file: r.csv}\nencoder: {bits: 18}\n" + kModelPart);
    ASSERT_EQ(place.run("simulate c.yaml -o " + std::string(folder) + "r.csv").status, 0);
    ASSERT_EQ(place.run("run " + std::string(folder) + "r.yaml -o out").status, 0);
    ASSERT_EQ(place.run("check " + std::string(folder) + "r.csv -o check.json").status, 3);  // too short
    const std::string all =
        stored(place.folder() / "out") + read(place, "check.json")["configuration"].dump();
    if (first.empty()) first = all;
    EXPECT_TRUE(all == first);
  }
}

TEST(ResolvedConfiguration, LiesBesideItsResultWithTheHashThatTheResultTells) {
  Workplace place;
  place.file("c.yaml", kUnlikeItsModel);
  place.file("check.yaml", kThreeCases);
  for (const auto& [command, result] :
       {std::pair("run", "result.json"), std::pair("detect", "result.json"), std::pair("fit", "result.json"),
        std::pair("diagnose", "diagnosis.json"), std::pair("blind run", "blind.json")}) {
    SCOPED_TRACE(command);
    const std::string config = std::string(command) == "blind run" ? "check.yaml" : "c.yaml";
    const std::string out = config == "check.yaml" ? "checked" : "out";
    const bool diagnoses = std::string(command) == "diagnose";
    const std::string few = diagnoses ? testing::excluding_all_but({"motor_coulomb_friction"}) : "";
    ASSERT_EQ(place.run(std::string(command) + " " + config + " -o " + out + few).status, 0);
    const json made = read(place, out + "/" + result);
    EXPECT_EQ(made["configuration"]["sha256"], sha256sum(place, out + "/resolved.yaml"));
    EXPECT_EQ(made["configuration"]["resolved"], text_of(place.folder() / out / "resolved.yaml"));
    EXPECT_EQ("gapscope " + made["version"].get<std::string>() + "\n", place.run("--version").out);
  }
}

TEST(ResolvedConfiguration, HoldsWhatTheCommandLineSays) {
  Workplace place;
  place.file("c.yaml", kUnlikeItsModel);
  const std::string excluded = testing::excluding_all_but({"motor_coulomb_friction", "cogging_torque"});
  ASSERT_EQ(place.run("diagnose c.yaml -o asked" + excluded).status, 0);
  ASSERT_EQ(place.run("diagnose asked/resolved.yaml -o again").status, 0);
  EXPECT_TRUE(stored(place.folder() / "asked") == stored(place.folder() / "again"));
  const std::string resolved = text_of(place.folder() / "asked/resolved.yaml");
  for (const char* effect : {"load_unbalance, ", "stribeck_friction, "})
    EXPECT_THAT(resolved.substr(resolved.find("exclude: [")), HasSubstr(effect));
  const json ranking = read(place, "asked/diagnosis.json")["ranking"];
  EXPECT_FALSE(ranking.empty());
  for (const json& candidate : ranking) EXPECT_NE(candidate["effect"], "stribeck_friction");
}

TEST(ResolvedConfiguration, IsMissedInNoFileOfBefore) {
  Workplace place;
  place.file("c.yaml", kUnlikeItsModel);
  ASSERT_EQ(place.run("detect c.yaml -o now").status, 0);
  json before = read(place, "now/result.json");
  before.erase("configuration");
  fs::copy(place.folder() / "now", place.folder() / "before", fs::copy_options::recursive);
  place.file("before/result.json", before.dump());
  EXPECT_EQ(place.run("report before").status, 0);
  const auto compared = place.run("compare before now -o both");
  EXPECT_EQ(compared.status, 0) << compared.err;
  const std::string made = read(place, "both/compare.json")["configuration"]["resolved"];
  EXPECT_THAT(made, HasSubstr("configuration_sha256: null}"));
  EXPECT_THAT(made, HasSubstr("configuration_sha256: " + sha256sum(place, "now/resolved.yaml") + "}"));
}

}  // namespace
}  // namespace gapscope
