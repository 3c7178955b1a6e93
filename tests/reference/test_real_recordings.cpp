// Recordings of real machines, where they are at hand.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "gapscope/recording/csv.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

std::filesystem::path data(const char* name) {
  const char* folder = std::getenv("GAPSCOPE_DATA");
  const std::filesystem::path root =
      folder != nullptr ? std::filesystem::path(folder)
                        : std::filesystem::path(GAPSCOPE_SOURCE_DIR).parent_path() / "shared" / "data";
  return root / name;
}

ModelEffect estimated(const char* name) {
  ModelEffect e;
  e.entry = find_effect(name);
  e.parameters[0].estimate = true;
  return e;
}

TEST(RealRecordings, ABallScrewAxisIsFoundAsItWasPublished) {
  const auto file = data("emps/emps_train.csv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no recording " << file;
  Recording recording = read_csv(file.string());
  recording.quantum = 5e-8;
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[kMotorInertia] = {190.0, true, kNaN, kNaN, {}};  // twice the truth
  model.parameters[kTorqueConstant].value = 1.0;
  model.parameters[kMotorDamping].estimate = true;
  model.effects = {estimated("motor_coulomb_friction"), estimated("constant_load_torque")};
  const FitSummary summary = fit_one(recording, model);
  EXPECT_EQ(summary.status, FitStatus::kConverged);
  // Published with 4 % relative force error: 95.11 kg, 203.5 N s/m, 20.39 N and 3.16 N.
  EXPECT_TRUE(contains(summary, "motor_inertia", 95.11)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_damping", 203.5)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_coulomb_friction.level_nm", 20.39)) << summary.full_report();
  EXPECT_NEAR(summary.find("motor_inertia")->value, 95.11, 1.0);
  // The model is not all there is, and the fit says so.
  EXPECT_NE(summary.full_report().find("does not explain"), std::string::npos);
}

}  // namespace
}  // namespace gapscope
