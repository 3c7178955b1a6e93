// The model that takes the terms of the torque balance.
#include <gtest/gtest.h>

#include "diagnosis/torque_model.h"

namespace gapscope {
namespace {

namespace view = internal::torque_view;

view::Term term(const char* name, std::initializer_list<double> theta, double shape = kNaN) {
  view::Term t{&view::law(name), shape, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(theta.size()))};
  std::copy(theta.begin(), theta.end(), t.theta.begin());
  return t;
}

/// By one body: 0.1 N m of Coulomb friction, and at low speed so much more.
ReferenceModel with_dip(double more) {
  view::Budget budget;
  budget.nominal = view::nominal_model();
  budget.addable = {term("inertia", {1e-3}), term("viscous", {1e-2}), term("motor_coulomb_friction", {0.1}),
                    term("stribeck_friction", {more}, 0.5)};
  return internal::diagnosis::with_terms({}, budget);
}

TEST(TorqueModel, FrictionAtRestDoesNotDriveTheMotor) {
  for (const auto& [more, ratio] : {std::pair{0.05, 0.5}, {-0.05, -0.5}, {-0.12, -0.9}}) {
    const ReferenceModel model = with_dip(more);
    ASSERT_EQ(model.effects.size(), 1u);
    const ModelEffect& stribeck = model.effects.front();
    ASSERT_EQ(std::string(stribeck.entry->name), "stribeck_friction");
    EXPECT_DOUBLE_EQ(stribeck.parameters[0].value, 0.1);
    EXPECT_DOUBLE_EQ(stribeck.parameters[1].value, ratio) << "the least that a fit may come to is -0.9";
  }
}

/// At one level of speed viscous and Coulomb friction are one number: who takes the one of the balance takes
/// the other.
TEST(TorqueModel, WhatTheModelHasAlreadyIsTakenWithTheRest) {
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[place::kMotorDamping] = ParameterSetting::sought(3e-2);
  ModelEffect coulomb;
  coulomb.entry = find_effect("motor_coulomb_friction");
  coulomb.parameters[0] = ParameterSetting::sought(0.0);
  model.effects = {coulomb};
  view::Budget budget;
  budget.nominal = view::nominal_model();
  budget.nominal.push_back(term("motor_coulomb_friction", {0.0}));
  budget.addable = {term("inertia", {1e-3}), term("viscous", {1e-2}), term("motor_coulomb_friction", {0.1})};
  const ReferenceModel taken = internal::diagnosis::with_terms(model, budget);
  EXPECT_DOUBLE_EQ(taken.parameters[place::kMotorDamping].value, 1e-2);
  EXPECT_DOUBLE_EQ(taken.effects.front().parameters[0].value, 0.1);
  model.effects.front().parameters[0].estimate = false;
  EXPECT_DOUBLE_EQ(internal::diagnosis::with_terms(model, budget).effects.front().parameters[0].value, 0.0);
}

TEST(TorqueModel, AFreeRunSaysNothingAgainstWhatAlonePredicts) {
  const auto scored = [](double free, double innovation) {
    internal::diagnosis::ScoredModel m;
    m.median_free = free, m.median_innovation = innovation;
    return m;
  };
  using internal::diagnosis::is_led_astray;
  EXPECT_TRUE(is_led_astray(scored(390.0, 1.18), scored(23.7, 22.4)));
  EXPECT_FALSE(is_led_astray(scored(390.0, 1.5), scored(23.7, 22.4))) << "it predicts, too, what is none";
  EXPECT_FALSE(is_led_astray(scored(390.0, 1.1), scored(23.7, 1.2))) << "the other predicts as well";
  EXPECT_FALSE(is_led_astray(scored(20.0, 1.1), scored(23.7, 22.4)));
}

/// Viscous friction that differs with direction acts without any Coulomb friction.
TEST(TorqueModel, AnEffectWithAnyAmountLeftHasNotVanished) {
  using internal::diagnosis::has_faded;
  using internal::diagnosis::has_vanished;
  const auto effect = [](const char* name, const std::vector<double>& values) {
    ModelEffect e;
    e.entry = find_effect(name);
    for (std::size_t i = 0; i < values.size(); ++i) e.parameters[i].value = values[i];
    return e;
  };
  EXPECT_TRUE(has_vanished(effect("friction_asymmetry", {0.0, 0.3, 0.0}))) << "a ratio of no level";
  EXPECT_FALSE(has_vanished(effect("friction_asymmetry", {0.0, 0.0, 0.2})));
  EXPECT_FALSE(has_vanished(effect("load_dependent_friction", {0.0, 0.2})));
  EXPECT_TRUE(has_vanished(effect("load_dependent_friction", {0.0, 0.0})));
  EXPECT_TRUE(has_vanished(effect("stribeck_friction", {0.0, 0.5, 0.1, 2.0})));
  EXPECT_FALSE(has_vanished(effect("shaft_compliance", {1.0}))) << "its first number is no amount";
  EXPECT_TRUE(has_faded(effect("input_dead_zone", {3e-6}), effect("input_dead_zone", {0.02})));
  EXPECT_FALSE(has_faded(effect("input_dead_zone", {3e-3}), effect("input_dead_zone", {0.02})));
  EXPECT_FALSE(
      has_faded(effect("friction_asymmetry", {0.1, 0.0, 0.2}), effect("friction_asymmetry", {2.0, 0.0, 0.3})))
      << "its damping is there";
  EXPECT_FALSE(has_faded(effect("shaft_compliance", {1.0}), effect("shaft_compliance", {100.0})));
}

}  // namespace
}  // namespace gapscope
