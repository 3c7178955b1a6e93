// One drive as CSV in SI and as .mat in other units: every command gives the same answers to both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/executable.h"
#include "inspection/rows.h"
#include "support/mat_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::Workplace;

/// si.csv, and daq.mat with milliseconds, milliamperes and counts of 18 bit.
void record_twice(const Workplace& place) {
  const testing::Rows rows = testing::rig();
  std::ofstream(place.folder() / "si.csv") << rows.csv();
  std::vector<double> ms, ma;
  std::vector<std::int32_t> counts;
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    ms.push_back(static_cast<double>(i));
    ma.push_back(1e3 * rows.u[i]);
    counts.push_back(
        static_cast<std::int32_t>(std::lround(rows.x1[i] * 262144.0 / (2.0 * std::numbers::pi))));
  }
  testing::MatWriter mat((place.folder() / "daq.mat").string());
  mat.column("Time", ms).column("i_q", ma);
  mat.array("ticks", MAT_C_INT32, MAT_T_INT32, {1, counts.size()}, counts.data());
}

nlohmann::json model_free(Workplace& place, const std::string& yaml, const std::string& report = "report") {
  place.file("c.yaml", yaml);
  const auto run = place.run("detect c.yaml -o " + report);
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(testing::text_of(place.folder() / report / "result.json"))["model_free"];
}

constexpr const char* kMat =
    "  file: daq.mat\n  columns: {time: Time, input: i_q, position: ticks}\n"
    "  units: {time: ms, input: mA, position: counts}\n";

TEST(Formats, AMatFileInUnitsOfItsOwnGivesTheGapOfTheCsv) {
  Workplace place;
  record_twice(place);
  const auto si = model_free(place, "recording: {file: si.csv}\nencoder: {bits: 18}\n", "si");
  const auto mat = model_free(place, std::string("recording:\n") + kMat + "encoder: {bits: 18}\n");
  EXPECT_EQ(si["verdict"], "backlash");
  EXPECT_NEAR(si["gap_rad"].get<double>(), mat["gap_rad"].get<double>(), 1e-9);
  EXPECT_EQ(si["events"].size(), mat["events"].size());
  EXPECT_THAT(testing::text_of(place.folder() / "report/resolved.yaml"),
              HasSubstr("units: {time: \"ms\", input: \"mA\", position: \"counts\"}"));
  const auto geared = model_free(
      place, std::string("recording:\n") + kMat + "  gear_ratio: {position: -50}\nencoder: {bits: 18}\n");
  EXPECT_NEAR(geared["gap_rad"].get<double>(), si["gap_rad"].get<double>() / 50.0, 1e-9);
}

TEST(Formats, CheckAndInitTakeAMatFileWithTheUnitsOnTheCommandLine) {
  Workplace place;
  record_twice(place);
  const std::string names = " daq.mat --time Time --input i_q --position ticks --time-unit ms";
  const auto raw = place.run("check" + names);
  EXPECT_EQ(raw.status, 3);
  EXPECT_THAT(raw.out, HasSubstr("units: {position: counts}"));
  const std::string told = names + " --input-unit mA --position-unit counts --bits 18";
  const auto check = place.run("check" + told);
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("(262144 per turn)"));
  const auto init = place.run("init" + told + " --gear-ratio 2 -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  const std::string yaml = testing::text_of(place.folder() / "drive.yaml");
  EXPECT_THAT(yaml, HasSubstr("units: {time: \"ms\", input: \"mA\", position: \"counts\"}"));
  EXPECT_THAT(yaml, HasSubstr("gear_ratio: {position: 2, load_position: 1}"));
  EXPECT_THAT(yaml, HasSubstr("encoder: {bits: 18}"));
  const auto detect = place.run("detect drive.yaml");
  EXPECT_EQ(detect.status, 0) << detect.err;
  EXPECT_EQ(detect.err, "");  // the encoder's step is the sheet's
}

TEST(Formats, UnitsThatAreNotKnownAreRefusedBeforeAnythingIsRead) {
  Workplace place;
  const auto unit = place.run("check none.csv --position-unit degree");
  EXPECT_EQ(unit.status, 2);
  EXPECT_THAT(unit.err, HasSubstr("--position-unit 'degree' is not known, expected rad, mrad, deg"));
  const auto counts = place.run("check none.csv --position-unit counts");
  EXPECT_EQ(counts.status, 2);
  EXPECT_THAT(counts.err, HasSubstr("--position-unit is counts, expected --bits"));
  EXPECT_EQ(place.run("check none.csv --gear-ratio 0").status, 2);
}

}  // namespace
}  // namespace gapscope
