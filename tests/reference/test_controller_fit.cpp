// Numbers of a controller that the fit finds, where a drive of the independent plant ran under a controller
// of its own code and only its target and its position were recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/closed_loop.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;
using independent_plant::BlindDrive;
using independent_plant::ControllerSettings;
using ::testing::HasSubstr;
namespace at = controller_place;

constexpr double kServoGain = 0.05, kSlope = 40.0, kPendulum = 0.02;

BlindDrive pendulum(double gravity = kPendulum) {
  BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.effects.load.unbalance_nm = gravity;
  return drive;
}

/// A cascade of P and P, its speed the difference of the readings.
ControllerSettings servo_loop(double dead_time = 0.0) {
  return {.rate = 1000.0,
          .position_gain = kSlope,
          .speed_forward = 0.0,
          .speed_gain = kServoGain,
          .dead_time_s = dead_time};
}

/// Target and position alone.
Recording under_target(const BlindDrive& drive, const ControllerSettings& controller,
                       std::uint64_t seed = 5) {
  const independent_plant::LoopRun loop = simulate_closed_loop(
      drive, {.course = independent_plant::Course::kSines, .travel = 2.0, .speed = 4.0}, controller,
      independent_plant::BlindSensor::with_bits(16), {}, {.duration = 3.0, .seed = seed, .tolerance = 1e-9});
  auto rows = std::make_shared<CommandRows>();
  rows->t = loop.stamps, rows->position = loop.run.recording.x1;
  for (const auto& target : loop.target) rows->target.push_back(target.x);
  rows->supply.assign(rows->t.size(), 1.0);
  Recording r = loop.run.recording;
  r.u.assign(r.size(), kNaN);
  r.x2.clear(), r.mode.clear();
  r.command = rows;
  return r;
}

ModelEffect gravity(double amplitude) {
  ModelEffect effect{find_effect("load_unbalance"), {}};
  effect.parameters = {ParameterSetting::known(amplitude), ParameterSetting::known(0.0),
                       ParameterSetting::known(1.0)};
  return effect;
}

/// Inertia, torque constant and gravity known, damping and the gain of the speed estimated.
ReferenceModel servo_model() {
  ReferenceModel model = known_model(pendulum());
  model.structure.has_load = false;
  estimate(model, kMotorDamping, 0.03);
  model.effects.push_back(gravity(kPendulum));
  ControllerModel& controller = model.controller.emplace();
  controller.fixed.rate = 1000.0;
  controller.fixed.kind = ControllerKind::kCascade;
  for (ParameterSetting& number : controller.numbers) number.value = 0.0;
  controller.numbers[at::kGain].value = kSlope;
  controller.numbers[at::kSpeedGain] = ParameterSetting::sought();
  return model;
}

std::string warnings_of(const FitSummary& summary) {
  std::string all;
  for (const Remark& w : summary.warnings) all += w.text() + "\n";
  return all;
}

void expect_near(const FitSummary& summary, const char* key, double truth, double share) {
  const FittedParameter* p = summary.find(key);
  ASSERT_NE(p, nullptr) << key;
  EXPECT_TRUE(p->identifiable) << summary.full_report();
  EXPECT_NEAR(p->value, truth, share * truth) << summary.full_report();
}

TEST(FittedController, HasTheGainOfTheDrivesOwn) {
  const FitSummary summary = fit_one(under_target(pendulum(), servo_loop()), servo_model());
  EXPECT_TRUE(contains(summary, "controller.velocity.gain", kServoGain)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_damping", 0.062)) << summary.full_report();
  EXPECT_LT(summary.find("controller.velocity.gain")->std, 0.01 * kServoGain);
  EXPECT_EQ(summary.trust, FitTrust::kGood);
}

/// Its target's slope is taken from update to update, the drive's own is that of the moment: half an update
/// apart, which its derivative and its delay take, not its gain.
TEST(FittedController, OfThePositionHasItsGain) {
  ControllerSettings settings = servo_loop();
  settings.speed_forward = 1.0;
  ReferenceModel model = servo_model();
  model.controller->fixed.kind = ControllerKind::kPosition;
  model.controller->numbers[at::kGain] = ParameterSetting::sought();
  model.controller->numbers[at::kDerivative] = ParameterSetting::sought(0.1);
  model.controller->numbers[at::kSpeedGain] = ParameterSetting::known(0.0);
  const FitSummary summary = fit_one(under_target(pendulum(), settings), model);
  expect_near(summary, "controller.position.gain", kSlope * kServoGain, 1e-3);
  expect_near(summary, "controller.position.derivative", kServoGain, 0.03);
}

TEST(FittedController, HasItsDelay) {
  ReferenceModel model = servo_model();
  model.controller->numbers[at::kDelay] = ParameterSetting::sought(0.001);
  const FitSummary summary = fit_one(under_target(pendulum(), servo_loop(0.0033)), model);
  expect_near(summary, "controller.delay", 0.0033, 0.02);
  expect_near(summary, "controller.velocity.gain", kServoGain, 0.01);
}

/// A drive with dry friction that stands at the first row: what acted until the first output did is unknown,
/// and its impulse no more than a speed to begin with.
TEST(FittedController, HasItsDelayThoughTheDriveStandsAtFirst) {
  BlindDrive drive = pendulum();
  drive.effects.motor.friction.level_nm = 0.002;
  ControllerSettings settings = servo_loop(0.0045);
  settings.rate = 200.0, settings.position_gain = 8.0, settings.speed_gain = 0.02;
  ReferenceModel model = servo_model();
  model.effects.push_back({find_effect("motor_coulomb_friction"), {}});
  model.effects.back().parameters[0] = ParameterSetting::sought(0.003);
  model.controller->fixed.rate = settings.rate;
  model.controller->numbers[at::kGain].value = settings.position_gain;
  model.controller->numbers[at::kDelay] = ParameterSetting::sought(0.0025);
  const FitSummary summary = fit_one(under_target(drive, settings), model);
  EXPECT_EQ(summary.trust, FitTrust::kGood) << summary.full_report();
  EXPECT_LT(summary.rmse, 1.3 * summary.floor);
  expect_near(summary, "controller.delay", settings.dead_time_s, 0.02);
}

TEST(FittedController, IsToldWithWhatItCannotBeToldApart) {
  ReferenceModel model = servo_model();
  model.effects.clear();
  estimate(model, kMotorInertia, 2e-3);
  const FitSummary summary = fit_one(under_target(pendulum(0.0), servo_loop()), model);
  const std::string told = warnings_of(summary);
  for (const char* key : {"controller.velocity.gain", "motor_inertia", "motor_damping"}) {
    EXPECT_FALSE(summary.find(key)->identifiable) << key;
    EXPECT_THAT(told, HasSubstr(key));
  }
  EXPECT_THAT(told, HasSubstr("only their ratios are determined"));
  EXPECT_THAT(told, HasSubstr("a known mass on a known arm"));
}

TEST(FittedController, HasTheScaleOfAKnownMass) {
  ReferenceModel model = servo_model();
  estimate(model, kMotorInertia, 2e-3);
  const FitSummary summary = fit_one(under_target(pendulum(), servo_loop()), model);
  expect_near(summary, "controller.velocity.gain", kServoGain, 0.01);
  expect_near(summary, "motor_inertia", 8.78e-4, 0.02);
}

/// From the first row on, where its integral begins.
TEST(FittedController, HasItsIntegral) {
  ControllerSettings settings = servo_loop();
  settings.integral_s = 0.05;
  ReferenceModel model = servo_model();
  model.controller->numbers[at::kSpeedIntegral] = ParameterSetting::sought(0.5);
  const FitSummary summary = fit_one(under_target(pendulum(), settings), model);
  expect_near(summary, "controller.velocity.gain", kServoGain, 0.01);
  expect_near(summary, "controller.velocity.integral", kServoGain / 0.05, 0.02);
}

}  // namespace
}  // namespace gapscope
