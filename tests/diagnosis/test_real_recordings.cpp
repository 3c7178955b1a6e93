// Recordings of real machines, where they are at hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/among.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/recording/recording_file.h"
#include "support/data.h"

namespace gapscope {
namespace {

/// At half the rate: in half the time.
Recording ball_screw(const char* name) {
  ReadOptions options;
  options.resample_rate = 500.0;
  Recording r = read_recording((testing::data_folder() / "emps" / name).string(), options);
  r.quantum = 5e-8;
  return r;
}

/// Inertia and viscous damping, nothing else.
ReferenceModel plain_axis() {
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[place::kMotorInertia] = {90.0, true, kNaN, kNaN, {}};
  model.parameters[place::kTorqueConstant].value = 1.0;
  model.parameters[place::kMotorDamping] = {200.0, true, kNaN, kNaN, {}};
  return model;
}

/// What tempts on this axis; the first test asks the whole catalogue.
DiagnosisOptions tempting() {
  return test::among({"motor_coulomb_friction", "friction_asymmetry", "stribeck_friction",
                      "constant_load_torque", "quadratic_drag", "input_delay", "actuator_lag",
                      "measurement_lag"});
}

void expect_friction(const Diagnosis& d) {
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kEffect);
  ASSERT_FALSE(d.effects.empty());
  EXPECT_EQ(d.effects.front(), "motor_coulomb_friction");
  EXPECT_EQ(d.mismatch.floor_from, FloorSource::kRepeatability);
  ASSERT_FALSE(d.ranking.empty());
  EXPECT_GE(d.ranking.front().shrink, 0.55);
  for (const char* wrong : {"backlash", "actuator_lag", "measurement_lag"}) {
    EXPECT_EQ(std::count(d.effects.begin(), d.effects.end(), wrong), 0);
    EXPECT_EQ(std::count(d.group.begin(), d.group.end(), wrong), 0);
  }
}

/// What Coulomb friction leaves of an axis whose friction and drive differ with the direction.
void expect_asymmetry_next(const Diagnosis& d) {
  const std::vector<std::string> either = {"friction_asymmetry", "constant_load_torque"};
  ASSERT_GE(d.effects.size(), 2u);
  EXPECT_EQ(std::count(either.begin(), either.end(), d.effects[1]), 1);
  EXPECT_TRUE(d.added[1].established);
  EXPECT_GT(d.added[1].shrink, 0.3);
  EXPECT_GE(d.mismatch.shrink, 0.85);
  EXPECT_GT(d.mismatch.remains, 1.3);  // what remains repeats: physics that the catalogue does not have
}

TEST(RealRecordings, ABallScrewAxisLacksCoulombFrictionAndNoBacklash) {
  GAPSCOPE_NEEDS_DATA();
  const Recording whole = ball_screw("emps_train.csv");
  const Recording first = part(whole, 0, whole.size() / 2),
                  second = part(whole, whole.size() / 2, whole.size() / 2);
  const MotorTrace train[] = {first.motor_trace()}, held_out[] = {second.motor_trace()};
  const Diagnosis d = diagnose(train, held_out, plain_axis());
  expect_friction(d);
  expect_asymmetry_next(d);
  EXPECT_TRUE(d.rivals.empty()) << d.rivals[1].effect << " explains next to nothing, and is no rival";
}

TEST(RealRecordings, WhereCoulombFrictionAloneDoesNotHelpItsAsymmetryIsNamed) {
  GAPSCOPE_NEEDS_DATA();
  const Recording whole = ball_screw("emps_train.csv");
  const std::size_t third = whole.size() / 3;
  const Recording most = part(whole, 0, whole.size() - third),
                  last = part(whole, whole.size() - third, third);
  const MotorTrace train[] = {most.motor_trace()}, held_out[] = {last.motor_trace()};
  const Diagnosis d = diagnose(train, held_out, plain_axis(), tempting());
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kEffect);
  ASSERT_FALSE(d.effects.empty());
  EXPECT_EQ(std::count(d.effects.begin(), d.effects.end(), "friction_asymmetry"), 1);
  EXPECT_GE(d.mismatch.shrink, 0.85);
}

TEST(RealRecordings, TheSameOnARecordingWithForcePulses) {
  GAPSCOPE_NEEDS_DATA();
  const Recording plain = ball_screw("emps_train.csv"), pulses = ball_screw("emps_pulses.csv");
  const MotorTrace train[] = {plain.motor_trace()}, held_out[] = {pulses.motor_trace()};
  const Diagnosis d = diagnose(train, held_out, plain_axis(), tempting());
  expect_friction(d);
  for (const AddedEffect& a : d.added)
    for (const NamedValue& p : a.parameters)
      EXPECT_FALSE(p.key == "stiction_ratio" && p.ci95.low < -1.0) << "less than no friction at rest";
  ASSERT_EQ(d.held_out_runs.size(), 1u);
  EXPECT_GT(d.held_out_runs.front().fit, 89.5)
      << d.held_out_runs.front().rmse;  // R² 0.989; of all effects 90.1
  EXPECT_NEAR(d.looked_at_hz.high, d.budget.band_hz, 1e-9);
}

}  // namespace
}  // namespace gapscope
