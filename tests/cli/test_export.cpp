#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::text_of;
using testing::Workplace;

const std::string kExported =
    "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 5, noise: 1.0e-5, plant: "
    "independent, excitation: {sine: {amplitude: 0.58, frequency: 1}}}\nfit: {starts: 1}\nmodel: " +
    testing::kPaperModel;

TEST(Export, TakesTheFittedModelOfAReportIntoAFolderOfItsOwn) {
  Workplace place;
  place.file("drive.yaml", kExported);
  ASSERT_EQ(place.run("fit drive.yaml -o report").status, 0);
  const auto made = place.run("export report --to mjcf -o mjcf --quiet");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("mjcf/drive.xml"));
  EXPECT_THAT(text_of(place.folder() / "mjcf/drive.xml"), HasSubstr("<mujoco model=\"drive\">"));
  EXPECT_THAT(text_of(place.folder() / "mjcf/certificate.md"), HasSubstr("| `gap` | exact |"));
  const auto stored = nlohmann::json::parse(text_of(place.folder() / "mjcf/certificate.json"));
  EXPECT_EQ(stored["schema"], "gapscope.export/1");
  EXPECT_EQ(stored["files"].size(), 2u);
  const std::string before = testing::stored(place.folder() / "mjcf");
  EXPECT_EQ(place.run("export report --to mjcf -o mjcf --quiet").status, 0);
  EXPECT_EQ(testing::stored(place.folder() / "mjcf"), before);
}

/// Who takes the file sees what it does not have, not only who reads the certificate.
TEST(Export, SaysInItsHeadWhatTheDiagnosisLeftUnexplained) {
  Workplace place;
  place.file("drive.yaml",
             "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 2, seed: 3, "
             "excitation: {sine: {amplitude: 0.58, frequency: 1}}, "
             "model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}}\nmodel: " +
                 testing::kPaperModel);
  const std::string nothing_fits = testing::excluding_all_but({"cogging_torque"});
  ASSERT_EQ(place.run("diagnose drive.yaml -o report" + nothing_fits).status, 0);
  const auto stored = nlohmann::json::parse(text_of(place.folder() / "report/diagnosis.json"));
  ASSERT_EQ(stored["verdict"], "unknown") << "or this is no test";
  const std::string said = fmt::format("This model lacks {:.3g} N m rms of torque on what was held out (",
                                       stored["gap"]["after_torque_nm"].get<double>());
  for (const std::string format : {"mjcf", "c", "sdf", "urdf", "isaac"}) {
    const auto made = place.run("export report --to " + format + " -o " + format);
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("warning: " + said));
    EXPECT_THAT(text_of(place.folder() / format / "certificate.md"), HasSubstr(said)) << format;
  }
  const std::string xml = "-->\n<!-- " + said;
  EXPECT_THAT(text_of(place.folder() / "mjcf/drive.xml"), HasSubstr(xml));
  EXPECT_THAT(text_of(place.folder() / "mjcf/drive_fragment.xml"), HasSubstr(xml));
  EXPECT_THAT(text_of(place.folder() / "sdf/drive.sdf"), HasSubstr(xml));
  EXPECT_THAT(text_of(place.folder() / "urdf/drive.urdf"), HasSubstr(xml));
  EXPECT_THAT(text_of(place.folder() / "c/drive.h"), HasSubstr("*/\n/* " + said));
  EXPECT_THAT(text_of(place.folder() / "isaac/drive_cfg.py"), HasSubstr("\n# " + said));
  EXPECT_EQ(place.run("export report/fitted.yaml --to mjcf -o again").status, 0);
  EXPECT_EQ(text_of(place.folder() / "again/drive.xml"), text_of(place.folder() / "mjcf/drive.xml"));
  auto followed = stored;  // as if something had been added that brings the motion to the floor
  followed["verdict"] = "effect", followed["gap"]["remains_ratio"] = 0.9;
  followed["gap"]["floor_torque_nm"] = followed["gap"]["after_torque_nm"].get<double>() / 3.0;
  place.file("report/diagnosis.json", followed.dump());
  EXPECT_THAT(place.run("export report --to c -o followed").err, Not(HasSubstr("This model")));
  followed["gap"]["remains_ratio"] = 3.0;
  place.file("report/diagnosis.json", followed.dump());
  EXPECT_THAT(place.run("export report --to c -o left").err,
              HasSubstr("warning: This model, with all that its diagnosis added, still lacks "));
  followed["effects"] = {"input_delay"}, followed["error_budget"]["uncounted"] = {"input_delay"};
  followed["gap"]["after_rad"] = 3.0 * followed["gap"]["floor_rad"].get<double>();
  followed["added"] = nlohmann::json::parse(
      R"([{"effect": "input_delay", "cause": "established", "group": ["input_delay"], "probability": null,
           "parameters": {}, "units": {}, "parameters_ci95": {}, "shrink": 0.9, "shrink_ci95": null,
           "after_torque_nm": null}])");
  place.file("report/diagnosis.json", followed.dump());
  EXPECT_THAT(place.run("export report --to c -o uncounted").err,
              HasSubstr("warning: This model, with all that its diagnosis added, still misses "))
      << "the torque has not fallen with the motion";
}

TEST(Export, LeavesAFolderAloneThatHoldsSomethingElse) {
  Workplace place;
  place.file("drive.yaml", kExported);
  place.file("robot/drive.xml", "<mujoco/>");
  const auto refused = place.run("export drive.yaml --to mjcf -o robot");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("robot: holds 'drive.xml'"));
  EXPECT_EQ(text_of(place.folder() / "robot/drive.xml"), "<mujoco/>");
  ASSERT_EQ(place.run("export drive.yaml --to mjcf -o mine").status, 0);
  place.file("mine/drive.xml", "<!-- changed by hand -->");
  EXPECT_EQ(place.run("export drive.yaml --to mjcf -o mine").status, 2);
  EXPECT_EQ(text_of(place.folder() / "mine/drive.xml"), "<!-- changed by hand -->");
}

TEST(Export, SaysWhatItCannotTake) {
  Workplace place;
  place.file("recorded.yaml",
             "name: r\nencoder: {bits: 18}\nrecording: {file: r.csv}\nmodel: "
             "{parameters: {motor_inertia: 1.0e-3, torque_constant: 0.1}}\n");
  place.file("empty/x.txt", "");
  EXPECT_THAT(place.run("export recorded.yaml --to mjcf -o o").err, HasSubstr("of the model is not known"));
  EXPECT_THAT(place.run("export empty --to mjcf -o o").err, HasSubstr("holds no fitted.yaml"));
  EXPECT_EQ(place.run("export recorded.yaml --to blend -o o").status, 2);
}

}  // namespace
}  // namespace gapscope
