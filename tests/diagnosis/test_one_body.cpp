// A drive of one body that lacks two effects: its torque balance and its encoder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/among.h"
#include "diagnosis/torque_model.h"
#include "independent_plant/simulate.h"

namespace gapscope {
namespace {

using namespace internal::diagnosis;

constexpr double kRate = 500.0;

Recording under(const independent_plant::BlindDrive& drive, const std::function<double(double)>& input,
                std::uint64_t noise) {
  constexpr double kDuration = 3.0;
  std::vector<double> u;
  for (int i = 0; i < static_cast<int>(kRate * kDuration); ++i) u.push_back(input(2.0 * kPi * i / kRate));
  const auto sensor = independent_plant::BlindSensor::with_bits(18, 0.5);
  return simulate_blind_command(drive, u, sensor,
                                {kRate, kDuration, noise, independent_plant::kFastTolerance})
      .recording;
}

// Detents pass at up to 24 Hz, and a lag shows where the input changes fast: above the 16 Hz to which the
// balance is drawn up it knows of neither, and the inertia takes the lag.
TEST(OneBody, IsToldWhatLeavesItsEncoderNothingRatherThanWhatTheBalanceSees) {
  independent_plant::BlindDrive d;
  d.load = independent_plant::BlindLoad::kNone;
  d.motor_inertia = 1.885e-3, d.motor_damping = 0.06;
  d.effects.motor.cogging = {5.5e-3, 52.0, 0.0, 0.0};
  d.effects.command.lag_s = 2.6e-3;
  const Recording train = under(
      d, [](double t) { return std::sin(1.1 * t) * (0.7 + 0.3 * std::sin(0.37 * t)); }, 1);
  const Recording held_out = under(
      d, [](double t) { return 0.6 * std::sin(0.8 * t) + 0.4 * std::sin(2.7 * t); }, 2);
  ReferenceModel sheet;
  sheet.structure.has_load = false;
  sheet.set("torque_constant", ParameterSetting::known(d.torque_constant));
  sheet.set("motor_inertia", ParameterSetting::sought(1.7e-3));
  sheet.set("motor_damping", ParameterSetting::sought(0.04));
  const MotorTrace fitted[] = {train.motor_trace()}, judging[] = {held_out.motor_trace()};
  const Diagnosis found =
      diagnose(fitted, judging, sheet,
               test::among({"motor_coulomb_friction", "cogging_torque", "torque_ripple", "input_delay",
                            "actuator_lag", "quadratic_drag", "constant_load_torque", "input_dead_zone"}));
  EXPECT_EQ(found.effects, (std::vector<std::string>{"cogging_torque", "actuator_lag"}));
  EXPECT_LT(found.mismatch.after, 1.3 * found.mismatch.floor);
  ASSERT_TRUE(found.whole_run.has_value());
  EXPECT_LT(found.whole_run->after, 0.1 * found.whole_run->before);
  EXPECT_TRUE(std::isnan(found.outside_probability)) << "learned on drives without an error budget";
  ASSERT_FALSE(found.ranking.empty());
  for (const RankedEffect& e : found.ranking) EXPECT_TRUE(std::isnan(e.probability)) << e.effect;
}

// Below the band's top a delay and a lag of one time are the same law of the torque: the motion tells them
// apart.
TEST(OneBody, ALagOfTheTorqueIsNoDelayOfTheInput) {
  independent_plant::BlindDrive d;
  d.load = independent_plant::BlindLoad::kNone;
  d.motor_inertia = 1.885e-3, d.motor_damping = 0.02;
  d.effects.motor.friction.level_nm = 0.01;
  d.effects.command.lag_s = 12e-3;
  const auto many = [](double shift) {
    return [shift](double t) {
      double u = 0.0;
      for (int i = 1; i <= 12; ++i) u += 0.1 * std::sin(0.4 * i * t + shift * i * i);
      return u;
    };
  };
  const Recording train = under(d, many(0.7), 1), held_out = under(d, many(1.9), 2);
  ReferenceModel sheet;
  sheet.structure.has_load = false;
  sheet.set("torque_constant", ParameterSetting::known(d.torque_constant));
  sheet.set("motor_inertia", ParameterSetting::sought(1.7e-3));
  sheet.set("motor_damping", ParameterSetting::sought(0.03));
  const MotorTrace fitted[] = {train.motor_trace()}, judging[] = {held_out.motor_trace()};
  const Diagnosis found = diagnose(fitted, judging, sheet,
                                   test::among({"motor_coulomb_friction", "input_delay", "actuator_lag",
                                                "measurement_lag", "input_dead_zone"}));
  const auto lag = std::ranges::find(found.added, "actuator_lag", &AddedEffect::effect);
  ASSERT_TRUE(lag != found.added.end()) << ::testing::PrintToString(found.effects);
  EXPECT_EQ(lag->group, std::vector<std::string>{"actuator_lag"});
  EXPECT_EQ(std::ranges::count(found.effects, "input_delay"), 0);
  EXPECT_NEAR(lag->parameters.front().value, 12e-3, 0.5e-3);
}

// Where an arm is held level gravity is nearly a constant torque: with friction it looks as friction that
// differs with the direction, until the unbalance is in the model.
TEST(OneBody, OfALevelArmFrictionIsNotToldAsAsymmetricOnceItsGravityIsKnown) {
  independent_plant::BlindDrive d;
  d.load = independent_plant::BlindLoad::kNone;
  d.torque_constant = 1.0;
  d.motor_inertia = 0.13, d.motor_damping = 0.9;
  d.effects.motor.friction.level_nm = 1.3;
  d.effects.load.unbalance_nm = 2.12, d.effects.load.unbalance_phase_rad = 0.5 * kPi;
  const Recording train = under(
      d, [](double t) { return 2.12 + 3.0 * std::sin(1.1 * t) * (0.7 + 0.3 * std::sin(0.37 * t)); }, 1);
  const Recording held_out = under(
      d, [](double t) { return 2.12 + 2.0 * std::sin(0.8 * t) + 1.5 * std::sin(2.7 * t); }, 2);
  ReferenceModel sheet;
  sheet.structure.has_load = false;
  sheet.set("torque_constant", ParameterSetting::known(1.0));
  sheet.set("motor_inertia", ParameterSetting::sought(0.12));
  sheet.set("motor_damping", ParameterSetting::sought(0.8));
  const MotorTrace fitted[] = {train.motor_trace()}, judging[] = {held_out.motor_trace()};
  const Diagnosis found = diagnose(fitted, judging, sheet,
                                   test::among({"motor_coulomb_friction", "friction_asymmetry",
                                                "load_unbalance", "constant_load_torque", "quadratic_drag"}));
  EXPECT_EQ(found.effects, (std::vector<std::string>{"motor_coulomb_friction", "load_unbalance"}));
  ASSERT_EQ(found.added.size(), 2u);
  const NamedValue& level = found.added.front().parameters.front();
  EXPECT_LT(level.ci95.low, 1.3 + 1e-3);
  EXPECT_GT(level.ci95.high, 1.3 - 1e-3);
}

// A model whose numbers are estimated takes any that its configuration has: it would seem to be right.
TEST(OneBody, OfAModelThatLacksNothingButHasWrongNumbersTellsWhichAreWrong) {
  independent_plant::BlindDrive d;
  d.load = independent_plant::BlindLoad::kNone;
  d.motor_inertia = 1.885e-3, d.motor_damping = 0.06;
  const Recording train = under(
      d, [](double t) { return std::sin(1.1 * t) * (0.7 + 0.3 * std::sin(0.37 * t)); }, 1);
  const Recording held_out = under(
      d, [](double t) { return 0.6 * std::sin(0.8 * t) + 0.4 * std::sin(2.7 * t); }, 2);
  const MotorTrace fitted[] = {train.motor_trace()}, judging[] = {held_out.motor_trace()};
  const auto with_sheet = [&](double inertia, double damping) {
    ReferenceModel sheet;
    sheet.structure.has_load = false;
    sheet.set("torque_constant", ParameterSetting::known(d.torque_constant));
    sheet.set("motor_inertia", ParameterSetting::sought(inertia));
    sheet.set("motor_damping", ParameterSetting::sought(damping));
    return diagnose(fitted, judging, sheet, test::among({"motor_coulomb_friction"}));
  };
  const Diagnosis wrong = with_sheet(1.3e-3, 0.12);
  ASSERT_EQ(wrong.verdict, DiagnosisVerdict::kNone);
  ASSERT_EQ(wrong.refitted.size(), 2u);
  const RefittedNumber& damping = wrong.refitted[0];  // twice what it is, the farther off
  EXPECT_EQ(damping.key, "motor_damping");
  EXPECT_EQ(damping.configured, 0.12);
  EXPECT_NEAR(damping.fitted, d.motor_damping, damping.ci95.high - damping.ci95.low)
      << "four standard errors";
  const Diagnosis right = with_sheet(wrong.refitted[1].fitted, damping.fitted);
  EXPECT_TRUE(right.refitted.empty());
}

// Without friction and dead zone the best torque constant is too small, and the balance keeps that: with both
// it is farther from the motion than the model without them, and the refit of all is nearer. Numbers that
// bring it nearer are not kept either where the refit brings it far nearer.
TEST(OneBody, WhoseWeightGivesTheScaleIsRefittedWhereTheBalanceBringsItNoNearer) {
  constexpr double kWeight = 0.353;
  independent_plant::BlindDrive d;
  d.load = independent_plant::BlindLoad::kNone;
  d.torque_constant = 0.716, d.motor_inertia = 6.1e-3, d.motor_damping = 0.041;
  d.effects.motor.friction.level_nm = 0.03;
  d.effects.load.unbalance_nm = kWeight;
  d.effects.command.dead_zone = 0.06, d.effects.command.noise = 0.02;
  const Recording train = under(
      d, [](double t) { return 0.45 * std::sin(0.9 * t) * (0.7 + 0.3 * std::sin(0.37 * t)); }, 1);
  const Recording held_out = under(
      d, [](double t) { return 0.25 * std::sin(0.6 * t) + 0.2 * std::sin(1.7 * t); }, 2);
  const auto with = [](const char* name, std::initializer_list<ParameterSetting> numbers) {
    ModelEffect effect;
    effect.entry = find_effect(name);
    std::copy(numbers.begin(), numbers.end(), effect.parameters.begin());
    return effect;
  };
  using Setting = ParameterSetting;
  ReferenceModel sheet;
  sheet.structure.has_load = false;
  sheet.set("torque_constant", Setting::sought(0.6));
  sheet.set("motor_inertia", Setting::sought(5e-3));
  sheet.set("motor_damping", Setting::sought(0.05));
  sheet.effects.push_back(
      with("load_unbalance", {Setting::known(kWeight), Setting::known(0.0), Setting::known(1.0)}));
  const MotorTrace fitted[] = {train.motor_trace()}, judging[] = {held_out.motor_trace()};
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const Study study = make_study(fitted, judging, sheet, options);
  const double hz = study.observer_hz;
  const ScoredModel nominal =
      judge(nullptr, fit_nominal(study.train, study.sheet, options.fit, hz), study.held_out, hz);
  ReferenceModel balanced = nominal.fitted.model;
  balanced.effects.push_back(with("motor_coulomb_friction", {Setting::sought(0.025)}));
  balanced.effects.push_back(with("input_dead_zone", {Setting::sought(0.065)}));
  const ScoredModel as_balanced = judge(nullptr, {balanced, {}, 0.0, {}, {}, true}, study.held_out, hz);
  const ScoredModel taken = refitted_from(study, balanced, nominal);
  EXPECT_GT(as_balanced.median_free, nominal.median_free);
  EXPECT_LT(taken.median_free, 0.5 * nominal.median_free);
  EXPECT_GT(taken.median_free, options.fit.rejected_ratio) << "which is taken for what it is anyway";
  EXPECT_NEAR(taken.fitted.model.parameters[place::kTorqueConstant].value, d.torque_constant, 0.02);
  EXPECT_FALSE(taken.fitted.balanced);

  ReferenceModel halfway = taken.fitted.model;
  for (ModelEffect& effect : halfway.effects)
    if (effect.entry != find_effect("load_unbalance")) effect.parameters[0].value *= 0.8;
  const ScoredModel nearer = judge(nullptr, {halfway, {}, 0.0, {}, {}, true}, study.held_out, hz);
  EXPECT_LT(nearer.median_free, nominal.median_free);
  EXPECT_GT(nearer.median_free, 3.0 * taken.median_free);
  EXPECT_FALSE(refitted_from(study, halfway, nominal).fitted.balanced);
}

}  // namespace
}  // namespace gapscope
