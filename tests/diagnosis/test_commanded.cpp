// A servo that tells its target and its position alone, under a controller that is known or not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/among.h"
#include "drives/closed_loop.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
namespace at = controller_place;

constexpr double kServoInertia = 8.78e-4, kServoConstant = 0.172, kServoDamping = 0.062;
constexpr double kServoSlope = 40.0, kServoGain = 0.05, kArmTorque = 0.1;

independent_plant::ReferenceMotion motion_over(double travel) {
  return {.course = independent_plant::Course::kSines, .travel = travel, .speed = 4.0};
}

/// Without an input: target and position.
Recording told_by(const independent_plant::LoopRun& loop) {
  auto rows = std::make_shared<CommandRows>();
  rows->t = loop.stamps, rows->position = loop.run.recording.x1;
  for (const auto& target : loop.target) rows->target.push_back(target.x);
  rows->supply.assign(rows->t.size(), 1.0);
  Recording r = loop.run.recording;
  r.command = rows;
  return r;
}

independent_plant::BlindDrive servo() {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.motor_inertia = kServoInertia, drive.torque_constant = kServoConstant,
  drive.motor_damping = kServoDamping;
  return drive;
}

/// A drive of the independent plant with an arm, and with dry friction that its model lacks.
Recording servo_recording(std::uint64_t seed, double travel) {
  independent_plant::BlindDrive drive = servo();
  drive.effects.load.unbalance_nm = kArmTorque;
  drive.effects.motor.friction.level_nm = 0.03;
  return told_by(simulate_closed_loop(
      drive, motion_over(travel),
      {.rate = 500.0, .position_gain = kServoSlope, .speed_forward = 0.0, .speed_gain = kServoGain},
      independent_plant::BlindSensor::with_bits(16), {}, {.duration = 4.0, .seed = seed, .tolerance = 1e-8}));
}

DriveController firmware(double gain) {
  DriveController c;
  c.kind = ControllerKind::kCascade;
  c.gain = kServoSlope, c.speed_gain = gain;
  return c;
}

/// Damping estimated; the arm gives the scale.
ReferenceModel servo_sheet() {
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[place::kMotorInertia] = ParameterSetting::sought(1.2 * kServoInertia);
  model.parameters[place::kTorqueConstant] = ParameterSetting::known(kServoConstant);
  model.parameters[place::kMotorDamping] = ParameterSetting::sought(0.8 * kServoDamping);
  ModelEffect arm{find_effect("load_unbalance"), {}};
  arm.parameters = {ParameterSetting::known(kArmTorque), ParameterSetting::known(0.0),
                    ParameterSetting::known(1.0)};
  model.effects = {arm};
  return model;
}

Diagnosis diagnosed_servo(const ReferenceModel& sheet, double gain_of_inputs) {
  Recording train = servo_recording(5, 2.0), held_out = servo_recording(6, 1.5);
  for (Recording* r : {&train, &held_out}) r->u = commanded_input(firmware(gain_of_inputs), r->motor_trace());
  DiagnosisOptions options = test::among({"motor_coulomb_friction", "quadratic_drag"});
  options.threads = 1;
  options.controller = firmware(gain_of_inputs);
  const MotorTrace fitted[] = {train.motor_trace()}, judged[] = {held_out.motor_trace()};
  return diagnose(fitted, judged, sheet, options);
}

TEST(CommandedServo, IsJudgedUnderItsController) {
  const Diagnosis d = diagnosed_servo(servo_sheet(), kServoGain);
  EXPECT_THAT(d.effects, ElementsAre("motor_coulomb_friction"));
  ASSERT_TRUE(d.closed_loop);
  ASSERT_EQ(d.closed_loop->recordings.size(), 1u);
  EXPECT_LT(d.closed_loop->after, 0.1 * d.closed_loop->before);
  EXPECT_LT(d.closed_loop->after, 3.0 * d.mismatch.floor);
}

/// The fit of a model without friction takes another gain; with what is found it is that of the firmware.
TEST(CommandedServo, HasItsGainEstimatedAnewWithEachStep) {
  ReferenceModel sheet = servo_sheet();
  ControllerModel& c = sheet.controller.emplace(ControllerModel::known(firmware(kServoGain)));
  c.numbers[at::kSpeedGain] = ParameterSetting::sought(1.3 * kServoGain);
  const Diagnosis d = diagnosed_servo(sheet, 1.3 * kServoGain);
  EXPECT_THAT(d.effects, ElementsAre("motor_coulomb_friction"));
  ASSERT_TRUE(d.fitted.controller);
  EXPECT_NEAR(d.fitted.controller->numbers[at::kSpeedGain].value, kServoGain, 0.02 * kServoGain);
  ASSERT_TRUE(d.closed_loop);
  EXPECT_LT(d.closed_loop->after, 3.0 * d.mismatch.floor);
}

constexpr double kDeadTime = 2.3e-3;  // within a row of 5 ms

/// A servo that lacks nothing, whose firmware acts later.
Recording late_recording(std::uint64_t seed, double travel, double gain) {
  return told_by(simulate_closed_loop(servo(), motion_over(travel),
                                      {.rate = 200.0,
                                       .position_gain = kServoSlope,
                                       .speed_forward = 0.0,
                                       .speed_gain = gain,
                                       .dead_time_s = kDeadTime},
                                      independent_plant::BlindSensor::with_bits(16), {.lead_s = 0.5},
                                      {.duration = 4.0, .seed = seed, .tolerance = 1e-8}));
}

DriveController late_firmware(double gain) {
  DriveController c = firmware(gain);
  c.delay = kDeadTime;
  return c;
}

Diagnosis diagnosed_late(const ReferenceModel& sheet, double gain) {
  Recording train = late_recording(5, 2.0, gain), held_out = late_recording(6, 1.5, gain);
  for (Recording* r : {&train, &held_out}) command_by(late_firmware(gain), *r);
  DiagnosisOptions options = test::among({"motor_coulomb_friction", "quadratic_drag"});
  options.threads = 1;
  options.controller = late_firmware(gain);
  const MotorTrace fitted[] = {train.motor_trace()}, judged[] = {held_out.motor_trace()};
  return diagnose(fitted, judged, sheet, options);
}

TEST(CommandedServo, LacksNothingWhereItsDeadTimeIsKnown) {
  ReferenceModel sheet = servo_sheet();
  sheet.effects.clear();
  const Diagnosis d = diagnosed_late(sheet, 6.0 * kServoGain);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kNone);
  EXPECT_LT(d.mismatch.before, 1.3 * d.mismatch.floor);
  ASSERT_TRUE(d.closed_loop);
  EXPECT_LT(d.closed_loop->before, 3.0 * d.mismatch.floor);
}

/// It acts once in the loop, not in the model of the drive as well.
TEST(CommandedServo, LacksNothingWhereItsDeadTimeIsEstimated) {
  ReferenceModel sheet = servo_sheet();
  sheet.effects.clear();
  ControllerModel& c = sheet.controller.emplace(ControllerModel::known(late_firmware(kServoGain)));
  c.numbers[at::kDelay] = ParameterSetting::sought(0.6 * kDeadTime);
  const Diagnosis d = diagnosed_late(sheet, kServoGain);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kNone);
  ASSERT_TRUE(d.fitted.controller);
  EXPECT_NEAR(d.fitted.controller->numbers[at::kDelay].value, kDeadTime, 0.2 * kDeadTime);
  ASSERT_TRUE(d.closed_loop);
  EXPECT_LT(d.closed_loop->before, 3.0 * d.mismatch.floor);
}

constexpr double kSaturation = 4.0, kVoltStep = 0.01;  // the supply is read in such steps

/// A servo that lacks nothing, on a supply that sags under its commands.
Recording sagging_recording(std::uint64_t seed, double travel, double volt_step) {
  const independent_plant::LoopRun loop =
      simulate_closed_loop(servo(), motion_over(travel),
                           {.rate = 200.0,
                            .position_gain = kServoSlope,
                            .speed_forward = 0.0,
                            .speed_gain = kServoGain,
                            .limit = kSaturation,
                            .supply_sag = 0.2},
                           independent_plant::BlindSensor::with_bits(16), {.lead_s = 0.5},
                           {.duration = 4.0, .seed = seed, .tolerance = 1e-8});
  Recording r = told_by(loop);
  auto rows = std::make_shared<CommandRows>(*r.command);
  for (std::size_t i = 0; i < rows->supply.size(); ++i)
    rows->supply[i] = volt_step * std::round(loop.supply[i] / volt_step);
  r.command = rows;
  DriveController c = firmware(kServoGain);
  c.saturation = kSaturation;
  command_by(c, r);
  return r;
}

Diagnosis diagnosed_sagging(double volt_step) {
  const Recording train = sagging_recording(5, 2.0, volt_step),
                  held_out = sagging_recording(6, 1.5, volt_step);
  ReferenceModel sheet = servo_sheet();
  sheet.effects.clear();
  DiagnosisOptions options = test::among({"motor_coulomb_friction", "quadratic_drag"});
  options.threads = 1;
  const MotorTrace fitted[] = {train.motor_trace()}, judged[] = {held_out.motor_trace()};
  return diagnose(fitted, judged, sheet, options);
}

/// What half a step of the supply moves is in the floor: read ten times as finely, the floor is the
/// encoder's.
TEST(CommandedServo, LacksNothingWhereItsSupplyIsReadInSteps) {
  const Diagnosis steps = diagnosed_sagging(kVoltStep), fine = diagnosed_sagging(1e-4);
  EXPECT_EQ(steps.verdict, DiagnosisVerdict::kNone);
  EXPECT_EQ(fine.verdict, DiagnosisVerdict::kNone);
  EXPECT_GT(steps.mismatch.floor, 3.0 * fine.mismatch.floor);
  EXPECT_GT(steps.mismatch.before, 1.3 * fine.mismatch.floor);
  EXPECT_THAT(steps.mismatch.floor_of, ::testing::HasSubstr("supply"));
  EXPECT_THAT(fine.mismatch.floor_of, ::testing::Not(::testing::HasSubstr("supply")));
}

/// A recorded input was made by nobody that is known.
TEST(CommandedServo, IsNotJudgedInALoopThatIsNotKnown) {
  Recording train = servo_recording(5, 2.0);
  train.u = commanded_input(firmware(kServoGain), train.motor_trace());
  train.command.reset();
  DiagnosisOptions options = test::among({"motor_coulomb_friction"});
  options.controller = firmware(kServoGain);
  const MotorTrace fitted[] = {train.motor_trace()};
  EXPECT_FALSE(diagnose(fitted, {}, servo_sheet(), options).closed_loop);
}

}  // namespace
}  // namespace gapscope
