// Where a fit begins that is told a mass, an inertia or a friction in place of the torque constant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/rigs.h"
#include "reference/torque_scale.h"

namespace gapscope {
namespace {

using namespace test;
using internal::reference::torque_scale;
using ::testing::HasSubstr;

constexpr double kConstant = 0.172, kInertia = 8.78e-4, kGravity = 0.05, kFriction = 0.01;

/// An arm that hangs down, shaken by several sines.
const Recording& shaken() {
  static const Recording recording = [] {
    independent_plant::BlindDrive drive;
    drive.load = independent_plant::BlindLoad::kNone;
    drive.effects.load.unbalance_nm = kGravity;
    drive.effects.motor.friction.level_nm = kFriction;
    independent_plant::BlindExcitation excitation;
    excitation.waveform = independent_plant::Waveform::kMultisine;
    return independent_plant::simulate_blind(drive, excitation, independent_plant::BlindSensor::with_bits(18),
                                             {500.0, 4.0, 1, 1e-10})
        .recording;
  }();
  return recording;
}

ModelEffect effect(const char* name, std::initializer_list<ParameterSetting> settings) {
  ModelEffect e{find_effect(name), {}};
  std::copy(settings.begin(), settings.end(), e.parameters.begin());
  return e;
}

/// The torque constant is sought, and nothing else is known.
ReferenceModel unknown() {
  ReferenceModel model;
  model.structure.has_load = false;
  model.set("torque_constant", ParameterSetting::sought());
  model.set("motor_inertia", ParameterSetting::sought());
  model.set("motor_damping", ParameterSetting::sought());
  model.set("mass_ratio", ParameterSetting::known(0.0));
  return model;
}

ReferenceModel with_a_mass() {
  ReferenceModel model = unknown();
  model.effects.push_back(effect(
      "load_unbalance",
      {ParameterSetting::known(kGravity), ParameterSetting::sought(0.0), ParameterSetting::known(1.0)}));
  return model;
}

double constant_of(const ReferenceModel& model) {
  const MotorTrace trace = shaken().motor_trace();
  return torque_scale({&trace, 1}, model).constant;
}

/// A start need not be exact: speeds are slopes over 20 ms, and the angle of the arm is taken as 0.
TEST(TorqueScale, IsThatOfWhatIsKnown) {
  EXPECT_NEAR(constant_of(with_a_mass()) / kConstant, 1.0, 0.2);
  ReferenceModel inertia = with_a_mass();
  inertia.effects.front().parameters[0] = ParameterSetting::sought(kGravity);  // no longer known
  inertia.set("motor_inertia", ParameterSetting::known(kInertia));
  EXPECT_GT(constant_of(inertia), 0.0);
  EXPECT_TRUE(std::isnan(constant_of(unknown())));
}

TEST(TorqueScale, AFrictionThatIsReadInUnitsOfTheInputDoesNotSpoilTheFit) {
  ReferenceModel model = with_a_mass();
  model.effects.push_back(
      effect("motor_coulomb_friction", {ParameterSetting::sought(kFriction / kConstant * 10.0)}));
  const MotorTrace trace = shaken().motor_trace();
  const FitSummary fitted = fit({&trace, 1}, model);
  ASSERT_TRUE(fitted.converged());
  EXPECT_NEAR(fitted.find("torque_constant")->value / kConstant, 1.0, 0.02);
  EXPECT_NEAR(fitted.find("motor_coulomb_friction.level_nm")->value / kFriction, 1.0, 0.1);
  EXPECT_THAT(fitted.full_report(), HasSubstr("is it in units of u"));
}

}  // namespace
}  // namespace gapscope
