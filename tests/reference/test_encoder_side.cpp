// The encoder on the load: what the reference reads of the drive from x2 alone.
#include <gtest/gtest.h>

#include "gapscope/simulation/stepper.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

ReferenceModel model_seen_from_load(const independent_plant::BlindDrive& drive) {
  ReferenceModel model = known_model(drive);
  model.structure.encoder = EncoderSide::kLoad;
  return model;
}

Recording recording_of_load(const independent_plant::BlindSensor& sensor) {
  BlindRig run;
  run.sensor = sensor;
  run.drive.x2 = 0.004;
  return read_on_load(run.recording(), sensor, 1);
}

TEST(EncoderOnLoad, TellsTheGapThatTheMotorCrossesUnseen) {
  const auto sensor = independent_plant::BlindSensor::with_bits(16, 0.7);
  ReferenceModel model = model_seen_from_load({});
  estimate(model, kGap, 0.03);
  estimate(model, kMotorDamping, 0.08);
  const FitSummary summary = fit_one(recording_of_load(sensor), model);
  EXPECT_TRUE(contains(summary, "gap", 0.0188)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_damping", 0.062)) << summary.full_report();
  EXPECT_EQ(summary.trust, FitTrust::kGood) << summary.why;
  EXPECT_LT(summary.find("gap")->std, 0.02 * 0.0188);
}

TEST(EncoderOnLoad, JudgesTheLoadsMotionNotTheMotors) {
  const Recording r = recording_of_load(independent_plant::BlindSensor::with_bits(20));
  const FitSummary summary = fit_one(r, [] {
    ReferenceModel model = model_seen_from_load({});
    estimate(model, kGap, 0.0188);
    return model;
  }());
  const FitTrace& trace = summary.traces.front();
  EXPECT_EQ(trace.encoder, EncoderSide::kLoad);
  double square = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    square += std::pow(r.x2[i] - trace.x2[i], 2) / static_cast<double>(r.size());
    apart = std::max(apart, std::abs(trace.x1[i] - trace.x2[i]));
  }
  EXPECT_NEAR(std::sqrt(square), summary.rmse, 1e-12);
  EXPECT_LT(summary.rmse, 1.3 * summary.floor);
  EXPECT_GT(apart, 0.4 * 0.0188);  // the motor's own motion is kept beside it
}

TEST(EncoderOnLoad, CorrectsTheLoadInTheGapAndBothInContact) {
  PlantModel<double> plant = plant_model({1e-3, 0.2, 0.0, 1.0, 0.02, 0.0, 0.0, 500.0, 0.1}, {});
  plant.structure.encoder = EncoderSide::kLoad;
  DriveStepper<double> stepper(plant, 1e-3);
  stepper.reset({0.1, 0.0, 0.1, 0.0});
  EXPECT_EQ(stepper.measured(), 0.1);
  stepper.inject(1e-3, 0.5);
  EXPECT_EQ(stepper.state().x1, 0.1);
  EXPECT_EQ(stepper.state().w1, 0.0);
  EXPECT_EQ(stepper.state().x2, 0.101);
  EXPECT_EQ(stepper.state().w2, 0.5);
  stepper.reset({0.111, 0.0, 0.1, 0.0});
  stepper.inject(1e-3, 0.5);
  EXPECT_EQ(stepper.state().x1, 0.112);
  EXPECT_EQ(stepper.state().x2, 0.101);
  EXPECT_EQ(stepper.measured(), 0.101);
}

TEST(EncoderOnLoad, SeesTheLoadThroughALaggingSensor) {
  const EffectEntry* lag = find_effect("measurement_lag");
  ASSERT_NE(lag, nullptr);
  PlantModel<double> plant = plant_model({1e-3, 0.2, 0.0, 1.0, 0.02, 0.0, 0.0, 500.0, 0.1}, {});
  plant.structure.encoder = EncoderSide::kLoad;
  const double tau = 0.02;
  add_effect(plant, *lag, std::span<const double>(&tau, 1));
  DriveStepper<double> stepper(plant, 1e-3);
  stepper.reset({0.0, 0.0, 0.0, 1.0});  // the load coasts through the gap at 1 rad/s
  for (int i = 0; i < 5; ++i) stepper.step(0.0);
  const double t = 5e-3;
  EXPECT_NEAR(stepper.measured(), t - tau * (1.0 - std::exp(-t / tau)), 1e-12);
}

}  // namespace
}  // namespace gapscope
