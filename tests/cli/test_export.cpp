#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
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
