#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/data.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::text_of;
using testing::Workplace;

/// A report of the paper's rig with a gap, made by the plant that shares no code with the estimators.
void make_report(Workplace& place, const std::string& name, const std::string& gap, int seed) {
  place.file(name + ".yaml",
             "name: " + name +
                 "\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 5, noise: 1.0e-5, plant: "
                 "independent, seed: " +
                 std::to_string(seed) +
                 ", excitation: {sine: {amplitude: 0.58, frequency: 1}}, model: {parameters: {gap: " + gap +
                 "}}}\nmodel: " + testing::kPaperModel);
  const auto made = place.run("detect " + name + ".yaml");
  ASSERT_EQ(made.status, 0) << made.err;
}

TEST(Compare, AGapThatGrewIsToldAndOneThatDidNotIsNot) {
  Workplace place;
  make_report(place, "march", "0.019", 1);
  make_report(place, "april", "0.019", 2);
  make_report(place, "june", "0.025", 3);
  const auto same = place.run("compare reports/march reports/april");
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, StartsWith("The same: every difference is within the tolerance.\n"));
  EXPECT_THAT(same.out, HasSubstr("gap (model-free)\n"));
  EXPECT_THAT(same.out, HasSubstr("\n0 changed, 2 same, 0 open, of 2 differences"));
  const auto grown = place.run("compare reports/march reports/april reports/june -o both");
  EXPECT_EQ(grown.status, 0) << grown.err;
  EXPECT_EQ(grown.err, "");
  const auto stored = nlohmann::json::parse(text_of(place.folder() / "both/compare.json"));
  EXPECT_EQ(stored["schema"], "gapscope.compare/2");
  const auto& gap = stored["quantities"]["model_free.gap_rad"]["changes"];
  EXPECT_EQ(gap[0]["verdict"], "same");
  EXPECT_EQ(gap[1]["verdict"], "changed");
  EXPECT_NEAR(gap[1]["difference"].get<double>(), 0.006, 3e-4);
  EXPECT_LT(gap[1]["ci95"][1].get<double>() - gap[1]["ci95"][0].get<double>(), 3.5e-3);
  const std::string report = text_of(place.folder() / "both/report.md"),
                    png = text_of(place.folder() / "both/gap_over_recordings.png");
  EXPECT_EQ(place.run("report both").status, 0);
  EXPECT_EQ(text_of(place.folder() / "both/report.md"), report);
  EXPECT_EQ(text_of(place.folder() / "both/gap_over_recordings.png"), png);
  const auto into = place.run("compare reports/march reports/june -o reports/june/");
  EXPECT_EQ(into.status, 2);
  EXPECT_THAT(into.err, StartsWith("reports/june/: is one of the reports itself, expected"));
  place.file("reports/july/diagnosis.json", "{}");
  const auto diagnosed = place.run("compare reports/march reports/july -o other");
  EXPECT_EQ(diagnosed.status, 2);
  EXPECT_THAT(diagnosed.err, StartsWith("reports/july/diagnosis.json"));
  place.file("reports/june/result.json", "{\"schema\": \"gapscope.result/1\", ");
  const auto damaged = place.run("compare reports/march reports/june -o other");
  EXPECT_EQ(damaged.status, 2);
  EXPECT_EQ(damaged.out, "");
  EXPECT_THAT(damaged.err, StartsWith("reports/june/result.json:1: is no valid JSON"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "other"));
}

/// The report of a locked output, read without a model.
void detect_locked(Workplace& place, const std::string& file, const std::string& name) {
  const std::string csv = (testing::data_folder() / file).string();
  const auto begun = place.run("init " + csv + " --model locked --input-unit N·m -o " + name + ".yaml");
  ASSERT_EQ(begun.status, 0) << begun.err;
  const auto made = place.run("detect " + name + ".yaml -o reports/" + name);
  ASSERT_EQ(made.status, 0) << made.err;
}

/// The author's definition of play gives 33.5 mrad for the standard gear and 2.9 for the preloaded one, and
/// up the ladder of preload 27.0, 28.4, 5.1, 4.8 and 3.5 mrad.
TEST(Compare, APreloadedGearIsToldFromAWornOneInTheFirstLine) {
  GAPSCOPE_NEEDS_DATA();
  Workplace place;
  detect_locked(place, "cycloidal/baseline_pos1.csv", "baseline");
  detect_locked(place, "cycloidal/splitpreload3_pos1.csv", "split");
  const auto told = place.run("compare reports/baseline reports/split");
  EXPECT_THAT(told.out, StartsWith("Changed: lost motion at ±3.95 N·m (model-free) fell from 33.7 ± "));
  for (const char* step : {"00", "05", "10"})
    detect_locked(place, "preload_ladder/" + std::string(step) + "_preload.csv", std::string("step_") + step);
  const auto lost = [&](const std::string& from, const std::string& to) {
    EXPECT_EQ(place.run("compare reports/step_" + from + " reports/step_" + to + " -o ladder").status, 0);
    const auto stored = nlohmann::json::parse(text_of(place.folder() / "ladder/compare.json"));
    for (const auto& [name, q] : stored["quantities"].items()) {
      EXPECT_FALSE(q["quantity"] == "loop_friction" && q["changes"][0]["verdict"] == "changed" &&
                   q["changes"][0]["high"].is_number() && q["changes"][0]["high"] < 0.0)
          << name << " fell from " << from << " to " << to;
      if (q["quantity"] == "lost_motion")
        return std::pair(q["changes"][0]["verdict"].get<std::string>(),
                         q["changes"][0]["difference"].get<double>());
    }
    return std::pair(std::string("no lost motion"), 0.0);
  };
  EXPECT_EQ(lost("00", "05").first, "changed");
  EXPECT_NEAR(lost("00", "05").second, -0.0219, 5e-4);
  EXPECT_EQ(lost("05", "10").first, "changed");
  EXPECT_LT(lost("05", "10").second, 0.0);
}

TEST(Compare, ANumberThatWasChangedSinceIsWarnedOf) {
  Workplace place;
  make_report(place, "march", "0.019", 1);
  make_report(place, "april", "0.019", 2);
  const auto changed = nlohmann::json::parse(text_of(place.folder() / "reports/april/result.json"));
  auto lie = changed;
  lie["model_free"]["gap_rad"] = 0.029;
  place.file("reports/april/result.json", lie.dump());
  const auto told = place.run("compare reports/march reports/april");
  EXPECT_EQ(told.status, 0);
  EXPECT_THAT(told.err, HasSubstr("reports/april: result.json was changed since gapscope wrote it"));
  EXPECT_THAT(told.err,
              HasSubstr("reports/april: the gap is 0.029 in result.json, outside its own interval"));
  EXPECT_THAT(told.err, ::testing::Not(HasSubstr("reports/march: ")));
  std::filesystem::remove(place.folder() / "reports/april/files.json");
  place.file("reports/april/result.json", changed.dump());
  EXPECT_EQ(place.run("compare reports/march reports/april").err, "") << "copied without its list";
}

}  // namespace
}  // namespace gapscope
