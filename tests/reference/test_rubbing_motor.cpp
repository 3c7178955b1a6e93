// A motor with a dry friction of its own before a gap: what a configuration of `gapscope init` asks of a fit,
// every number without a start. Recorded by the plant that shares no code with it.
#include <gtest/gtest.h>

#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

ReferenceModel nothing_known() {
  ReferenceModel model;
  model.parameters[kTorqueConstant].value = independent_plant::BlindDrive{}.torque_constant;
  for (int n = 0; n < kDriveParameterCount; ++n)
    if (n != kTorqueConstant) estimate(model, n);
  return model;
}

ReferenceModel with_friction(ReferenceModel model) {
  model.effects.push_back({find_effect("motor_coulomb_friction"), {ParameterSetting::sought()}});
  return model;
}

BlindRig rig_with(double friction) {
  BlindRig rig;
  rig.drive.effects.motor.friction.level_nm = friction;
  rig.excitation.amplitude = 0.58;
  rig.options.duration = 6.0;
  return rig;
}

TEST(RubbingMotor, ItsFrictionAndItsGapAreFoundWithoutAStart) {
  const BlindRig rig = rig_with(0.01);
  const FitSummary found = fit_one(rig.recording(), with_friction(nothing_known()));
  EXPECT_EQ(found.trust, FitTrust::kGood) << found.why.text();
  EXPECT_TRUE(contains(found, "gap", rig.drive.gap)) << found.find("gap")->value;
  EXPECT_TRUE(contains(found, "motor_coulomb_friction.level_nm", 0.01));
}

}  // namespace
}  // namespace gapscope
