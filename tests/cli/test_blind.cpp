// The blind check through the command: three commands, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::text_of;
using testing::Workplace;

constexpr const char* kBlindCheck =
    "name: check\nreport: {first_seed: 9300001, none: 2}\nrigs: [geared]\nduration: 2\n";

TEST(Blind, ThreeCommandsDoWhatOneDoes) {
  Workplace place;
  place.file("check.yaml", kBlindCheck);
  ASSERT_EQ(place.run("blind make check.yaml -o cases --labels labels.json").status, 0);
  const auto answered = place.run("blind answer cases -o answers.json -j 1");
  ASSERT_EQ(answered.status, 0) << answered.err;
  EXPECT_EQ(answered.err, "");  // no terminal, no progress
  const auto scored = place.run("blind score cases labels.json answers.json -o apart");
  ASSERT_EQ(scored.status, 0) << scored.err;
  EXPECT_THAT(scored.out, HasSubstr("no effect: none"));
  const auto whole = place.run("blind run check.yaml");
  ASSERT_EQ(whole.status, 0) << whole.err;
  for (const char* file : {"blind.json", "report.md"})
    EXPECT_EQ(text_of(place.folder() / "apart" / file), text_of(place.folder() / "reports/check" / file))
        << file;
  EXPECT_EQ(place.run("report apart").status, 0);
  EXPECT_THAT(text_of(place.folder() / "apart/report.md"), HasSubstr("no seal was announced"));
  const std::string seal = answered.out.substr(answered.out.find("seal") + 12, 64);
  ASSERT_EQ(place.run("blind score cases labels.json answers.json -o held --seal " + seal).status, 0);
  EXPECT_THAT(text_of(place.folder() / "held/report.md"), HasSubstr("the one that was announced (" + seal));
  EXPECT_THAT(text_of(place.folder() / "held/blind.json"), HasSubstr("\"announced_seal_sha256\": \"" + seal));
}

constexpr const char* kOwnDrive =
    "name: axis\nmodel: {parameters: {torque_constant: 0.172, motor_inertia: {value: 0.0018, estimate: true}, "
    "motor_damping: {value: 0.02, estimate: true}, mass_ratio: 0}}\nencoder: {bits: 16}\n";

TEST(Blind, ImplantsIntoOwnRecordingsInThreeCommandsAndInOne) {
  Workplace place;
  place.file("drive.yaml", std::string(kOwnDrive) +
                               "simulation: {rate: 500, duration: 4, excitation: {sine: {amplitude: 0.4, "
                               "frequency: 1.3}}}\n");
  ASSERT_EQ(place.run("simulate drive.yaml -o axis.csv").status, 0);
  place.file("axis.yaml",
             std::string(kOwnDrive) +
                 "recording: {file: axis.csv}\nimplant: {first_seed: 3, known: 1, outside: 0, none: 1, "
                 "effects: [input_delay]}\n");
  const auto made = place.run("blind implant axis.yaml -o cases --labels labels.json");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("2 in cases"));
  ASSERT_EQ(place.run("blind answer cases -o answers.json").status, 0);
  const auto scored = place.run("blind score cases labels.json answers.json -o apart");
  ASSERT_EQ(scored.status, 0) << scored.err;
  EXPECT_THAT(scored.out, HasSubstr("implant with a foretold share of 0.3 or more"));
  EXPECT_THAT(scored.out, HasSubstr("no implant: the effects of the recordings as they are"));
  ASSERT_EQ(place.run("blind run axis.yaml").status, 0);
  for (const char* file : {"blind.json", "report.md", "implants.png"})
    EXPECT_EQ(text_of(place.folder() / "apart" / file), text_of(place.folder() / "reports/axis" / file))
        << file;
  const auto simulated = place.run("blind implant drive.yaml -o others --labels others.json");
  EXPECT_EQ(simulated.status, 2);
  EXPECT_THAT(simulated.err, HasSubstr("drive.yaml: simulates, expected recording"));
  EXPECT_FALSE(place.content().contains("others"));
}

TEST(Blind, RefusesWhatWasChangedWithTheReasonAndWritesNothing) {
  Workplace place;
  place.file("check.yaml", kBlindCheck);
  ASSERT_EQ(place.run("blind run check.yaml -o all").status, 0);
  std::string labels = text_of(place.folder() / "all/labels.json");
  place.file("all/labels.json", labels.replace(labels.find("\"rig\": \"geared\""), 15, "\"rig\": \"heavy\""));
  const auto scored = place.run("blind score all/cases all/labels.json all/answers.json -o new");
  EXPECT_EQ(scored.status, 2);
  EXPECT_THAT(scored.err, HasSubstr("all/labels.json: has another label of case_001"));
  EXPECT_FALSE(place.content().contains("new"));
}

TEST(Blind, RefusesACheckWhosePartsShareASeed) {
  Workplace place;
  place.file("check.yaml", "report: {first_seed: 5, none: 3}\ncalibration: {first_seed: 1, known: 5}\n");
  const auto made = place.run("blind make check.yaml -o cases --labels labels.json");
  EXPECT_EQ(made.status, 2);
  EXPECT_THAT(made.err, HasSubstr("check.yaml:1: report has seeds from 5 on, which calibration has too"));
}

}  // namespace
}  // namespace gapscope
