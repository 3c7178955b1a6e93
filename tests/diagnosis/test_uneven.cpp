// Recordings with steps of their own length, diagnosed as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/recording/recording_file.h"
#include "support/data.h"
#include "support/temporary_file.h"
#include "support/uneven.h"

namespace gapscope {
namespace {

double several_sines(double t) {
  double u = 0.0;
  for (const double f : {0.7, 1.9, 4.3}) u += 0.4 * std::sin(2.0 * kPi * f * t + 3.0 * f);
  return u;
}

ReferenceModel one_body(double inertia, double torque_constant, double damping) {
  ReferenceModel model;
  model.structure.has_load = false;
  model.set("motor_inertia", ParameterSetting::sought(inertia));
  model.set("torque_constant", ParameterSetting::known(torque_constant));
  model.set("motor_damping", ParameterSetting::sought(damping));
  return model;
}

Diagnosis of_a_body_with_coulomb_friction(const test::UnevenClock& clock) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.motor_inertia *= 2.0;
  drive.effects.motor.friction.level_nm = 0.03;
  const auto sensor = independent_plant::BlindSensor::with_bits(16, 0.5);
  const Recording r = test::uneven_recording(drive, several_sines, sensor, clock);
  const MotorTrace train[] = {r.motor_trace()};
  return diagnose(train, {}, one_body(1.6 * 8.78e-4, drive.torque_constant, 0.05));
}

void expect_coulomb_friction(const Diagnosis& d) {
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kEffect);
  ASSERT_FALSE(d.effects.empty());
  EXPECT_EQ(d.effects.front(), "motor_coulomb_friction");
  EXPECT_NEAR(d.ranking.front().parameters.front().value, 0.03, 0.002);
  ASSERT_FALSE(d.traces.empty());
  EXPECT_EQ(d.traces.front().stamps.size(), d.traces.front().x1.size());
}

TEST(DiagnosisOfUnevenSteps, NamesCoulombFriction) {
  expect_coulomb_friction(of_a_body_with_coulomb_friction({1000.0, 8.0}));
}

TEST(DiagnosisOfUnevenSteps, NamesCoulombFrictionWhereRowsAreLost) {
  test::UnevenClock clock{1000.0, 8.0};
  clock.lost = 0.02;
  expect_coulomb_friction(of_a_body_with_coulomb_friction(clock));
}

/// A raw recording of the XL330 servo: what stands in the README of the data.
Recording servo(const std::string& name) {
  std::ifstream in(testing::data_folder() / "xl330" / (name + ".csv"));
  std::string line, text = "t,u,x1\n";
  for (std::getline(in, line); std::getline(in, line);) {
    double t = 0.0, goal = 0.0, x1 = 0.0, load = 0.0, volts = 0.0;
    char comma = ',';
    std::istringstream(line) >> t >> comma >> goal >> comma >> x1 >> comma >> load >> comma >> volts;
    const double duty = (load > 32767.0 ? load - 65536.0 : load) / 885.0;
    text += std::to_string(t) + "," + std::to_string(duty * volts) + "," + std::to_string(x1) + "\n";
  }
  const testing::TemporaryFile file(text, name + ".csv");
  ReadOptions options;
  options.uneven = UnevenRows::kStamped;
  Recording r = read_recording(file.path(), options);
  r.quantum = 2.0 * kPi / 4096.0;
  return r;
}

TEST(DiagnosisOfUnevenSteps, AServoWithAPendulumIsFittedAndDiagnosedAsItWasLogged) {
  GAPSCOPE_NEEDS_DATA();
  const Recording first = servo("sin_sin_kp400"), other = servo("sin_time_square_kp400");
  ASSERT_FALSE(first.even());
  const MotorTrace train[] = {first.motor_trace()}, held_out[] = {other.motor_trace()};
  const ReferenceModel model = one_body(0.05, 1.0, 0.5);
  const FitSummary fitted = fit(train, model);
  EXPECT_NE(fitted.status, FitStatus::kFailed) << fitted.full_report();
  EXPECT_GT(fitted.find("motor_inertia")->value, 0.0);
  DiagnosisOptions options;
  for (const EffectEntry* e : effect_table())
    if (e->name != std::string("load_unbalance") && e->name != std::string("motor_coulomb_friction"))
      options.excluded.emplace_back(e->name);
  const Diagnosis d = diagnose(train, held_out, model, options);
  EXPECT_NE(d.verdict, DiagnosisVerdict::kNotRun);
  EXPECT_NE(d.verdict, DiagnosisVerdict::kNone) << "a pendulum is no one body without gravity";
  ASSERT_FALSE(d.ranking.empty());
  EXPECT_EQ(d.ranking.front().effect, "load_unbalance");
}

}  // namespace
}  // namespace gapscope
