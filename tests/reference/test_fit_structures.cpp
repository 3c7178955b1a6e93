// Drives without a gap to cross, locked drives, and effects of the catalogue in the model.
#include <gtest/gtest.h>

#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

ModelEffect effect(const char* name, double start) {
  ModelEffect e;
  e.entry = find_effect(name);
  e.parameters[0].value = start;
  e.parameters[0].estimate = true;
  return e;
}

TEST(FitStructures, OneInertiaHasMotorParametersOnly) {
  BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kNone;
  ReferenceModel model = known_model(run.drive);
  model.structure.has_load = false;
  estimate(model, kMotorInertia, 2.0 * 8.78e-4);
  estimate(model, kMotorDamping);
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_EQ(summary.status, FitStatus::kConverged);
  EXPECT_EQ(summary.find("gap"), nullptr);
  EXPECT_EQ(summary.find("mass_ratio"), nullptr);
  EXPECT_TRUE(contains(summary, "motor_inertia", 8.78e-4)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_damping", 0.062)) << summary.full_report();
  EXPECT_TRUE(summary.traces[0].x2.empty());
  EXPECT_LT(summary.rmse, 1.2 * summary.floor);
}

TEST(FitStructures, ALockedLoadYieldsTheGapAndItsPlace) {
  BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kLocked;
  run.drive.x2 = 0.004;
  run.excitation.waveform = independent_plant::Waveform::kTriangle;
  ReferenceModel model = known_model(run.drive);
  model.structure.load = LoadKind::kLocked;
  estimate(model, kGap, 0.03);
  estimate(model, kMotorDamping);
  estimate(model, kContactStiffness, 150.0);
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_EQ(summary.find("mass_ratio"), nullptr);
  EXPECT_EQ(summary.find("load_damping"), nullptr);
  EXPECT_NEAR(summary.find("gap")->value, 0.0188, 1e-5) << summary.full_report();
  EXPECT_TRUE(contains(summary, "contact_stiffness", 200.0)) << summary.full_report();
  for (const double x2 : summary.traces[0].x2) ASSERT_NEAR(x2, 0.004, 1e-5);
}

TEST(FitStructures, AnEffectOfTheCatalogueIsFittedWithTheDrive) {
  BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kNone;
  run.drive.effects.motor.friction.level_nm = 0.02;
  ReferenceModel model = known_model(run.drive);
  model.structure.has_load = false;
  estimate(model, kMotorInertia, 1.5e-3);
  estimate(model, kMotorDamping, 0.09);
  model.effects.push_back(effect("motor_coulomb_friction", kNaN));
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_LT(summary.rmse, 1.2 * summary.floor) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_coulomb_friction.level_nm", 0.02)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_inertia", 8.78e-4)) << summary.full_report();
}

TEST(FitStructures, WithoutFreeParametersThePresentModelIsMeasured) {
  BlindRig run;
  run.drive.x2 = 0.006;
  const FitSummary summary = fit_one(run.recording(), known_model(run.drive));
  EXPECT_EQ(summary.status, FitStatus::kConverged);
  EXPECT_LT(summary.rmse, 1.2 * summary.floor) << summary.full_report();
}

}  // namespace
}  // namespace gapscope
