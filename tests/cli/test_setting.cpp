#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/text.h"
#include "cli/executable.h"

namespace gapscope {
namespace {

using testing::text_of;
using testing::Workplace;

std::string drive(const char* seed, const char* bits) {
  return std::string("name: quick\nencoder: {bits: ") + bits +
         "}\nsimulation: {rate: 500, duration: 2, seed: " + seed +
         ", excitation: {sine: {amplitude: 0.5, frequency: 1}}}\nmodel:\n"
         "  parameters: {motor_inertia: 0.001, torque_constant: 1, mass_ratio: 0, motor_damping: 0.01}\n";
}

TEST(SettingOption, TakesThePlaceOfWhatTheConfigurationSays) {
  Workplace place;
  place.file("c.yaml", drive("3", "18"));
  place.file("other.yaml", drive("4", "12"));
  ASSERT_EQ(place.run("simulate c.yaml --set simulation.seed=4 --set encoder.bits=12 -o set.csv").status, 0);
  ASSERT_EQ(place.run("simulate other.yaml -o other.csv").status, 0);
  ASSERT_EQ(place.run("simulate c.yaml -o c.csv").status, 0);
  const std::string set = text_of(place.folder() / "set.csv");
  EXPECT_EQ(set, text_of(place.folder() / "other.csv"));
  EXPECT_NE(set, text_of(place.folder() / "c.csv"));
}

TEST(SettingOption, IsInTheReportThatItMade) {
  Workplace place;
  place.file("c.yaml", drive("3", "18"));
  const auto detected = place.run("detect --set name=renamed c.yaml --set encoder.bits=16");
  ASSERT_EQ(detected.status, 0) << detected.err;
  const std::string resolved = text_of(place.folder() / "reports/renamed/resolved.yaml");
  EXPECT_THAT(resolved, ::testing::HasSubstr("name: \"renamed\""));
  EXPECT_THAT(resolved, ::testing::Not(::testing::HasSubstr("18")));
}

TEST(SettingOption, ThatTheSimulatedDriveDoesNotSeeIsWarnedOf) {
  Workplace place;
  const std::string own = ", model: {parameters: {motor_damping: 0.02}}, excitation";
  place.file("c.yaml", replaced(drive("3", "18"), ", excitation", own));
  const auto idle = place.run("simulate c.yaml --set model.parameters.motor_damping=0.03 -o idle.csv");
  EXPECT_EQ(idle.status, 0);
  EXPECT_THAT(idle.err, ::testing::HasSubstr("--set simulation.model.parameters.motor_damping changes it"));
  const auto seen = place.run("simulate c.yaml --set model.parameters.motor_inertia=0.002 -o seen.csv");
  EXPECT_EQ(seen.err, "");
  EXPECT_NE(text_of(place.folder() / "seen.csv"), text_of(place.folder() / "idle.csv"));
}

/// A fitted.yaml has its drive twice, and who sets a number of the model means the drive.
TEST(SettingOption, OfTheModelActsOnWhatAFittedConfigurationSimulatesAndExports) {
  Workplace place;
  const std::string model =
      "{parameters: {motor_inertia: 0.001, torque_constant: 1, mass_ratio: 0, motor_damping: 0.01}}";
  const std::string fitted =
      "name: quick_fitted\nencoder: {bits: 18}\nsimulation: {rate: 500, duration: 2, excitation: {sine: "
      "{amplitude: 0.5, frequency: 1}}, model: " +
      model + "}\nmodel: " + model + "\n";
  place.file("fitted.yaml", fitted);
  place.file("other.yaml", replaced(fitted, "0.01", "0.03"));
  const auto set = place.run("simulate fitted.yaml --set model.parameters.motor_damping=0.03 -o set.csv");
  EXPECT_EQ(set.status, 0);
  EXPECT_EQ(set.err, "");
  ASSERT_EQ(place.run("simulate other.yaml -o other.csv").status, 0);
  EXPECT_EQ(text_of(place.folder() / "set.csv"), text_of(place.folder() / "other.csv"));
  for (const char* key : {"model.parameters.motor_damping", "simulation.model.parameters.motor_damping"}) {
    ASSERT_EQ(place.run(std::string("export fitted.yaml --to mjcf -o m --set ") + key + "=0.03").status, 0);
    EXPECT_THAT(text_of(place.folder() / "m/quick.xml"), ::testing::HasSubstr("damping=\"0.03\"")) << key;
  }
  const auto wrong = place.run("simulate fitted.yaml --set model.parameters.gapp=1 -o wrong.csv");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, ::testing::HasSubstr("--set model.parameters.gapp: "));
}

TEST(SvgOption, DrawsEachFigureTwiceAndTheNextReportTidiesUp) {
  Workplace place;
  place.file("c.yaml", drive("3", "18"));
  const auto count = [&](const char* ending) {
    const auto content = place.content();
    return std::count_if(content.begin(), content.end(),
                         [&](const std::string& file) { return file.ends_with(ending); });
  };
  ASSERT_EQ(place.run("detect c.yaml --svg -o d").status, 0);
  EXPECT_GT(count(".png"), 0);
  EXPECT_EQ(count(".svg"), count(".png"));
  ASSERT_EQ(place.run("report d").status, 0);
  EXPECT_EQ(count(".svg"), 0);
  ASSERT_EQ(place.run("report d --svg").status, 0);
  EXPECT_EQ(count(".svg"), count(".png"));
  const auto bytes = [&](const char* file) { return std::filesystem::file_size(place.folder() / file); };
  const auto usual = bytes("d/fig2_input_and_displacement.png");
  ASSERT_EQ(place.run("report d --small").status, 0);
  EXPECT_LT(bytes("d/fig2_input_and_displacement.png"), usual / 2);
}

}  // namespace
}  // namespace gapscope
