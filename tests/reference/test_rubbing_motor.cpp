// A motor with a dry friction of its own before a gap: what a configuration of `gapscope init` asks of a fit,
// every number without a start. Recorded by the plant that shares no code with it.
#include <gtest/gtest.h>

#include "reference/rigs.h"
#include "reference/starts.h"

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

/// A drive that turns on as it swings: its travel is no measure of its gap. Drawn by that, it was not found.
TEST(RubbingMotor, AGapIsFoundInATravelOfManySwings) {
  BlindRig rig = rig_with(0.01);
  rig.drive.gap = 8e-3;
  rig.excitation.offset = 0.4;
  for (const double frequency : {1.0, 2.0}) {
    rig.excitation.frequency = frequency;
    const FitSummary found = fit_one(rig.recording(), with_friction(nothing_known()));
    EXPECT_EQ(found.trust, FitTrust::kGood) << found.why.text();
    EXPECT_NEAR(found.find("gap")->value, rig.drive.gap, 0.01 * rig.drive.gap);
  }
}

/// The balance tells the inertia of motor and load together: of a rotor that is known the load is the rest.
TEST(RubbingMotor, ALoadIsDrawnBesideARotorThatIsKnown) {
  BlindRig rig = rig_with(0.006);
  rig.drive.load_inertia = 8.0 * rig.drive.motor_inertia;
  rig.excitation.waveform = independent_plant::Waveform::kMultisine;
  rig.excitation.amplitude = 3.0;
  ReferenceModel model = with_friction(nothing_known());
  model.parameters[kMotorInertia] = ParameterSetting::known(rig.drive.motor_inertia);
  const Recording recording = rig.recording();
  const MotorTrace trace = recording.motor_trace();
  using namespace internal::reference;
  const FitProblem problem = make_problem({&trace, 1}, model, {});
  const StartPoints draws = drawn_points(problem, 5);
  ASSERT_EQ(draws.points.size(), 5u);
  for (const Solution& drawn : draws.points)
    EXPECT_NEAR(problem.numbers(drawn.q.data()).drive(kMassRatio), 8.0, 4.0);
}

/// Stiff teeth behind a small gap, in a motion of many times its width.
TEST(RubbingMotor, AStiffContactIsFoundFromTheGapOfAnotherEstimate) {
  BlindRig rig = rig_with(0.02);
  rig.drive.gap = 8e-3, rig.drive.contact_stiffness = 3000.0, rig.drive.contact_damping = 0.25;
  rig.options.duration = 3.0;
  const Recording recording = rig.recording();
  for (const double read : {7.3e-3, 10e-3}) {
    FitOptions seeded;
    seeded.gap_seed = read;
    const FitSummary found = fit_one(recording, with_friction(nothing_known()), seeded);
    EXPECT_EQ(found.find("gap")->start, read);
    EXPECT_EQ(found.trust, FitTrust::kGood) << read << ": " << found.why.text();
    EXPECT_TRUE(contains(found, "gap", rig.drive.gap)) << found.find("gap")->value;
  }
}

/// Its impacts leave so much of the balance that this tells an inertia of a hundredth: bounds from it would
/// cut the contact off.
TEST(RubbingMotor, AContactThatDissipatesMuchIsFoundThoughTheBalanceTellsNoInertia) {
  BlindRig rig = rig_with(0.006);
  rig.drive.gap = 9e-3, rig.drive.contact_stiffness = 3000.0, rig.drive.contact_damping = 1.5;
  rig.drive.motor_damping = 0.02;
  rig.options.duration = 4.0;
  FitOptions seeded;
  seeded.gap_seed = 9.5e-3;
  const FitSummary found = fit_one(rig.recording(), with_friction(nothing_known()), seeded);
  EXPECT_EQ(found.trust, FitTrust::kGood) << found.why.text();
  EXPECT_TRUE(contains(found, "gap", rig.drive.gap)) << found.find("gap")->value;
  EXPECT_TRUE(contains(found, "contact_damping", rig.drive.contact_damping));
  EXPECT_TRUE(contains(found, "motor_inertia", rig.drive.motor_inertia));
}

}  // namespace
}  // namespace gapscope
