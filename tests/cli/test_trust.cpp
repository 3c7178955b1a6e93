// What a report and the terminal say of a model that is right, and of one whose input has the wrong sign.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/executable.h"
#include "gapscope/base/statistics.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::text_of;
using testing::Workplace;

nlohmann::json result_of(const Workplace& place, const std::string& folder) {
  return nlohmann::json::parse(text_of(place.folder() / folder / "result.json"));
}

const std::string kRig =
    "encoder: {bits: 18}\nsimulation: {rate: 1000, duration: 6, noise: 1.0e-5, plant: independent, seed: 5, "
    "excitation: {sine: {amplitude: 0.58, frequency: 1}}}\nmodel: ";

/// The paper's rig, by the plant that shares no code with the estimators, and its recording read by two
/// configurations: as it is, and with an input of the wrong sign.
void make_recordings(Workplace& place) {
  place.file("made.yaml", "name: made\n" + kRig + testing::kPaperModel);
  ASSERT_EQ(place.run("simulate made.yaml -o right.csv").status, 0);
  std::istringstream rows(text_of(place.folder() / "right.csv"));
  std::string turned;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream cells(row);
    std::string t, u, x1;
    std::getline(cells, t, ','), std::getline(cells, u, ','), std::getline(cells, x1, ',');
    const bool header = t.find_first_of("0123456789") != 0;
    turned += header && t != "t" ? ""
                                 : t + "," +
                                       (header               ? u
                                        : u.starts_with("-") ? u.substr(1)
                                                             : "-" + u) +
                                       "," + x1 + "\n";
  }
  place.file("turned.csv", turned);
  for (const std::string name : {"right", "turned"})
    place.file(name + ".yaml",
               "name: " + name + "\nrecording: {file: " + name +
                   ".csv}\nencoder: {bits: 18}\nfit: {compare_parts: false}\nmodel: " + testing::kPaperModel);
}

TEST(Trust, AReadingOfAPositionInAnotherUnitThanDeclaredIsNotGood) {
  Workplace place;
  make_recordings(place);
  std::istringstream rows(text_of(place.folder() / "right.csv"));
  std::string degrees = "t,u,x1\n", row;
  for (std::getline(rows, row); std::getline(rows, row);) {
    double t = 0.0, u = 0.0, x1 = 0.0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf", &t, &u, &x1), 3) << row;
    degrees += fmt::format("{},{},{}\n", t, u, x1 * 180.0 / kPi);
  }
  place.file("degrees.csv", degrees);
  place.file("asked.yaml", "name: asked\nrecording: {file: degrees.csv}\n");
  const std::string declared = "name: declared\nrecording: {file: degrees.csv, units: {position: deg}}\n";
  place.file("declared.yaml", declared);
  const auto asked = place.run("detect asked.yaml"), told = place.run("detect declared.yaml");
  ASSERT_EQ(asked.status, 0) << asked.err;
  EXPECT_THAT(asked.err, HasSubstr("warning: degrees.csv: unit of x1: x1 steps by 360/262144: degrees?"));
  EXPECT_THAT(
      asked.out,
      HasSubstr(
          "if the recording is what it seems to be (x1 steps by 360/262144: degrees?). Trust: limited."));
  EXPECT_THAT(asked.out, HasSubstr("next        Mend the recording first: declare it"));
  EXPECT_THAT(told.out, HasSubstr("Trust: good."));
  EXPECT_THAT(told.err, Not(HasSubstr("degrees?")));
}

TEST(Trust, AFitThatIsInterruptedLeavesTheReadingWithoutAModel) {
  Workplace place;
  std::string longer = kRig;
  longer.replace(longer.find("duration: 6"), 11, "duration: 60");
  const std::string sought = "{estimate: true}";
  place.file("made.yaml", "name: made\n" + longer + testing::kPaperModel);
  ASSERT_EQ(place.run("simulate made.yaml -o long.csv").status, 0);
  place.file(
      "long.yaml",
      "name: long\nrecording: {file: long.csv}\nencoder: {bits: 18}\nmodel: {parameters: {torque_constant: "
      "0.172, motor_inertia: " +
          sought + ", load_damping: " + sought + ", load_coulomb_friction: " + sought +
          ", contact_stiffness: " + sought + ", contact_damping: " + sought + "}}\n");
  const auto run = place.run("run long.yaml", "timeout --foreground --preserve-status -s INT 4");
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the fit of the model was stopped"));
  EXPECT_THAT(run.out, HasSubstr("\ngap         The backlash gap is "));
  EXPECT_TRUE(result_of(place, "reports/long")["reference"].is_null());
}

TEST(Trust, TheAnswerHeadsTheTerminalTheReportAndTheResult) {
  Workplace place;
  make_recordings(place);
  const auto run = place.run("run right.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\ngap         The backlash gap is 18.999"));
  EXPECT_THAT(
      run.out,
      HasSubstr(" Trust: good.\nmodel error The fitted model, simulated freely, follows the motion to 99.9"));
  const auto result = result_of(place, "reports/right");
  EXPECT_EQ(result["reference"]["trust"], "good");
  EXPECT_GT(result["reference"]["fit_percent"].get<double>(), 99.0);
  EXPECT_EQ(result["answer"]["from"], "reference");
  EXPECT_NEAR(result["answer"]["gap_rad"].get<double>(), 0.019, 1e-5);
  const auto& card = result["answer"]["brief"];
  const std::string report = text_of(place.folder() / "reports/right/report.md");
  EXPECT_THAT(report, ::testing::StartsWith("# right\n\n> right.csv was made by `gapscope simulate`, "));
  EXPECT_THAT(report, HasSubstr("of a real drive.\n\n- **Gap:** " + card["gap"].get<std::string>() + "\n"));
  std::string all;
  for (std::string line : {"gap", "mismatch", "next"}) {
    const std::string text = card[line];
    if (line == "mismatch") line = "model error";
    line.resize(12, ' ');
    all += line + text + "\n";
  }
  all = replaced(all, "CONFIG`", "right.yaml`");  // which the terminal knows
  EXPECT_THAT(run.out, ::testing::EndsWith(all)) << "the terminal ends with the same card";
}

TEST(Trust, ARejectedModelHasNoIntervalInTheTerminalTheReportOrTheComparison) {
  Workplace place;
  make_recordings(place);
  ASSERT_EQ(place.run("fit right.yaml").status, 0);
  const auto fit = place.run("fit turned.yaml");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("gap         The gap is not known.\n"));
  EXPECT_THAT(fit.out, HasSubstr("next        Check the sign and the unit of the input u"));
  EXPECT_THAT(fit.out, Not(HasSubstr("["))) << "an interval";
  const std::string report = text_of(place.folder() / "reports/turned/report.md");
  EXPECT_THAT(report, Not(HasSubstr(" ± ")));
  EXPECT_THAT(report, Not(HasSubstr("(95 %")));
  const auto result = result_of(place, "reports/turned");
  EXPECT_EQ(result["reference"]["trust"], "rejected");
  EXPECT_EQ(result["answer"]["from"], "none");
  EXPECT_TRUE(result["answer"]["gap_rad"].is_null());
  const auto exported = place.run("export reports/turned --to c -o exported");
  EXPECT_THAT(exported.err, HasSubstr("warning: The fit of this model is rejected, so its numbers are not"));
  EXPECT_THAT(text_of(place.folder() / "exported/certificate.md"),
              HasSubstr("The fit of this model is rejected"));
  const auto compared = place.run("compare reports/right reports/turned");
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("left out, the model is rejected"));
  EXPECT_THAT(compared.out, Not(HasSubstr(", changed")));
  EXPECT_THAT(compared.err, HasSubstr("its fitted numbers are left out, the model is rejected."));
}

TEST(Trust, BothEstimatorsAreComparedOnlyWhereBothAreTrusted) {
  Workplace place;
  make_recordings(place);
  ASSERT_EQ(place.run("run turned.yaml").status, 0);
  const auto result = result_of(place, "reports/turned");
  EXPECT_TRUE(result["comparison"]["agree"].is_null());
  EXPECT_NE(result["answer"]["from"], "reference");
}

}  // namespace
}  // namespace gapscope
