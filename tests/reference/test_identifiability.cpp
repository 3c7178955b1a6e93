#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

void expect_not_identifiable(const FitSummary& summary, const char* key) {
  const FittedParameter* p = summary.find(key);
  ASSERT_NE(p, nullptr) << key;
  EXPECT_FALSE(p->identifiable) << summary.full_report();
  EXPECT_TRUE(std::isfinite(p->value));  // it keeps its value
  EXPECT_TRUE(std::isnan(p->ci95.low));
  EXPECT_TRUE(std::isnan(p->ci95.high));
  EXPECT_TRUE(std::isnan(p->std));
}

TEST(Identifiability, InertiaTorqueConstantAndDampingOfOneInertiaScaleTogether) {
  BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kNone;
  ReferenceModel model = known_model(run.drive);
  model.structure.has_load = false;
  for (const int n : {kMotorInertia, kTorqueConstant, kMotorDamping})
    estimate(model, n, 1.1 * numbers_of(run.drive)[n]);
  const FitSummary summary = fit_one(run.recording(), model);
  for (const char* key : {"motor_inertia", "torque_constant", "motor_damping"})
    expect_not_identifiable(summary, key);
  EXPECT_THAT(texts_of(summary.warnings),
              Contains(AllOf(HasSubstr("motor_inertia"), HasSubstr("torque_constant"),
                             HasSubstr("only their ratios are determined"), HasSubstr("known torque"))));
  // The combinations themselves are right.
  const double ratio = summary.find("motor_damping")->value / summary.find("motor_inertia")->value;
  EXPECT_NEAR(ratio / (0.062 / 8.78e-4), 1.0, 1e-3);
}

TEST(Identifiability, TorqueConstantAndInertiaAloneAreKnownAsARatio) {
  BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kNone;
  run.drive.motor_damping = 0.0;  // which would fix the scale
  run.excitation.offset = 0.0;
  run.excitation.amplitude = 0.1;
  ReferenceModel model = known_model(run.drive);
  model.structure.has_load = false;
  for (const int n : {kMotorInertia, kTorqueConstant}) estimate(model, n, 1.1 * numbers_of(run.drive)[n]);
  const FitSummary summary = fit_one(run.recording(), model);
  expect_not_identifiable(summary, "motor_inertia");
  EXPECT_THAT(texts_of(summary.warnings), Contains(AllOf(HasSubstr("motor_inertia and torque_constant"),
                                                         HasSubstr("only their ratio is determined"))));
}

TEST(Identifiability, ASineSaysWhatWouldSharpenTheContact) {
  BlindRig run;  // 1 Hz: some twenty impacts
  ReferenceModel model = known_model(run.drive);
  for (const int n : {kGap, kMotorDamping, kContactStiffness, kContactDamping})
    estimate(model, n, 1.1 * numbers_of(run.drive)[static_cast<std::size_t>(n)]);
  EXPECT_THAT(texts_of(fit_one(run.recording(), model).advice), ::testing::IsEmpty()) << "all within 5 %";
  run.sensor = independent_plant::BlindSensor::with_bits(13);
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_THAT(texts_of(summary.advice),
              Contains(AllOf(HasSubstr("contact_stiffness"), HasSubstr("impacts"))));
  EXPECT_THAT(texts_of(summary.advice),
              Contains(AllOf(HasSubstr("contact_damping"), HasSubstr("harder impacts"))));
  EXPECT_THAT(texts_of(summary.advice), ::testing::Not(Contains(HasSubstr("gap has a"))));
}

TEST(Identifiability, AllNineFreeLeaveGapAndMassRatioOnly) {
  BlindRig run;
  run.excitation.waveform = independent_plant::Waveform::kMultisine;
  ReferenceModel model = known_model(run.drive);
  for (int n = 0; n < kDriveParameterCount; ++n)
    model.parameters[static_cast<std::size_t>(n)].estimate = true;
  const FitSummary summary = fit_one(run.recording(), model);
  for (const char* key : {"motor_inertia", "torque_constant", "motor_damping", "load_damping",
                          "load_coulomb_friction", "contact_stiffness", "contact_damping"})
    expect_not_identifiable(summary, key);
  EXPECT_TRUE(summary.find("gap")->identifiable);
  EXPECT_TRUE(summary.find("mass_ratio")->identifiable);
}

TEST(Identifiability, WithoutContactNothingBehindTheGapIsSeen) {
  BlindRig run;  // ±3 mrad of travel within ±9.4 mrad of play
  run.excitation.amplitude = 0.007;
  run.options.duration = 3.0;
  ReferenceModel model = known_model(run.drive);
  estimate(model, kMotorDamping, 0.05);
  estimate(model, kContactStiffness, 150.0);
  estimate(model, kLoadDamping, 0.03);
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_TRUE(contains(summary, "motor_damping", 0.062)) << summary.full_report();
  expect_not_identifiable(summary, "contact_stiffness");
  expect_not_identifiable(summary, "load_damping");
  EXPECT_THAT(texts_of(summary.warnings),
              Contains(AllOf(HasSubstr("contact_stiffness"), HasSubstr("impacts"))));
}

}  // namespace
}  // namespace gapscope
