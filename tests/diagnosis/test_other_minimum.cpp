// A drive whose model ends in a poor minimum once the effect that it lacks is added.
#include <gtest/gtest.h>

#include "diagnosis/effect_starts.h"
#include "diagnosis/further.h"
#include "independent_plant/simulate.h"

namespace gapscope::internal::diagnosis {
namespace {

/// The model of a drive with detents, without them, and its recordings.
struct DriveWithDetents {
  Recording train, held_out;
  ReferenceModel sheet;
};

ReferenceModel sheet_of_drive_with_detents() {
  ReferenceModel sheet;
  const auto estimate = [&](int i, double start) {
    sheet.parameters[static_cast<std::size_t>(i)] = ParameterSetting::sought(start);
  };
  sheet.parameters[place::kMotorInertia] = ParameterSetting::known(1.2e-3);
  sheet.parameters[place::kTorqueConstant] = ParameterSetting::known(1.0);
  estimate(place::kMotorDamping, 0.01);
  estimate(place::kMassRatio, 1.2);
  estimate(place::kGap, 0.015);
  estimate(place::kLoadDamping, 0.01);
  estimate(place::kLoadCoulombFriction, 0.03);
  estimate(place::kContactStiffness, 500.0);
  estimate(place::kContactDamping, 0.2);
  ModelEffect friction;
  friction.entry = find_effect("motor_coulomb_friction");
  friction.parameters[0] = ParameterSetting::sought(0.005);
  sheet.effects.push_back(friction);
  return sheet;
}

DriveWithDetents drive_with_detents() {
  independent_plant::BlindDrive drive;
  drive.motor_inertia = 1.2e-3, drive.load_inertia = 1.5e-3, drive.torque_constant = 1.0;
  drive.motor_damping = 0.012, drive.load_damping = 0.01, drive.load_coulomb = 0.03;
  drive.gap = 0.012, drive.contact_stiffness = 900.0, drive.contact_damping = 0.3;
  drive.effects.motor.friction.level_nm = 0.01;
  drive.effects.motor.cogging.amplitude = 0.006, drive.effects.motor.cogging.periods_per_turn = 24.0;
  const auto recorded = [&](double amplitude, double frequency, double duration) {
    return simulate_blind(drive, {.amplitude = amplitude, .frequency = frequency},
                          independent_plant::BlindSensor::with_bits(18),
                          {1000.0, duration, 1, independent_plant::kFastTolerance})
        .recording;
  };
  return {recorded(0.15, 1.0, 5.0), recorded(0.11, 1.5, 4.0), sheet_of_drive_with_detents()};
}

/// Of the draws: without a value to begin with the drive is found from 8 of the seeds 1 to 10, not from 1
/// and 5.
constexpr std::uint64_t kSeed = 4;

/// The same with no value to begin with, as `gapscope init` writes it.
ReferenceModel without_starts(ReferenceModel sheet) {
  for (ParameterSetting& p : sheet.parameters)
    if (p.estimate) p.value = kNaN;
  sheet.effects.front().parameters[0].value = kNaN;
  return sheet;
}

/// Steps from a first one that has found the detents on a contact that hardly resists, but damps.
Additions steps_from_a_soft_contact(const DriveWithDetents& drive, const ReferenceModel& sheet) {
  const MotorTrace train[] = {drive.train.motor_trace()}, held_out[] = {drive.held_out.motor_trace()};
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  options.fit.seed = kSeed;
  const Study study = make_study(train, held_out, sheet, options);
  const EffectEntry* cogging = find_effect("cogging_torque");
  ReferenceModel soft = drive.sheet;
  soft.parameters[place::kContactStiffness].value = 7.2;
  soft.parameters[place::kContactDamping].value = 2.3;
  soft.parameters[place::kGap].value = 6.8e-3;
  soft.effects.front().parameters[0].value = 9.2e-3;
  soft.effects.push_back(searched_effect(*cogging, {6.2e-3, 24.0, 0.0, 0.0, kNaN, kNaN, kNaN}, study.turns));
  FirstSearch found;
  found.candidates = {judge(cogging, fit_near(study.train, soft, options.fit, study.observer_hz),
                            study.held_out, study.observer_hz)};
  found.before = found.candidates.front();
  found.decision.accepted = true;
  found.decision.group = {cogging};
  const FittedModel& there = found.candidates.front().fitted;
  EXPECT_LT(there.model.parameters[place::kContactStiffness].value, 50.0);
  EXPECT_GT(there.mean_cost, kRule.near_floor);
  return add_further(study, found);
}

void expect_the_drive(const Additions& added) {
  EXPECT_TRUE(at_floor(added.after));
  EXPECT_EQ(added.effects.size(), 1u) << "nothing is left for another";
  EXPECT_NEAR(added.after.fitted.model.parameters[place::kContactStiffness].value, 900.0, 90.0);
}

TEST(OtherMinimum, OfAnAddedEffectIsFoundFromTheGivenNumbersOfTheDrive) {
  const DriveWithDetents drive = drive_with_detents();
  expect_the_drive(steps_from_a_soft_contact(drive, drive.sheet));
}

/// The first search closed the gap, or softened the contact, to stand for detents that it did not know of.
TEST(OtherMinimum, OfAnAddedEffectIsSearchedForWhereTheGapHasNoGivenValue) {
  const DriveWithDetents drive = drive_with_detents();
  const Additions added = steps_from_a_soft_contact(drive, without_starts(drive.sheet));
  expect_the_drive(added);
  EXPECT_NEAR(added.after.fitted.model.parameters[place::kGap].value, 0.012, 1e-4);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
