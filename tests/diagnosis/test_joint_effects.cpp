// What a comparison with a simulator begins with, where only one side has an effect.
#include <gtest/gtest.h>

#include "diagnosis/joint_effects.h"

namespace gapscope::internal::diagnosis {
namespace {

ModelEffect sought(const char* name, std::initializer_list<double> values) {
  ModelEffect e;
  e.entry = find_effect(name);
  std::size_t i = 0;
  for (const double value : values) e.parameters[i++] = ParameterSetting::sought(value);
  return e;
}

Diagnosis having(const ModelEffect& effect) {
  Diagnosis d;
  d.fitted.effects = {effect};
  return d;
}

JointEffect only_in_drive(const ModelEffect& effect) {
  return joint_effects(having(effect), Diagnosis()).front().front();
}

TEST(JointEffects, OfFrictionThatGrowsWithTheLoadTheRatioIsAskedForWhereItIsNotThere) {
  const JointEffect j = only_in_drive(sought("load_dependent_friction", {0.02, 0.29}));
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_TRUE(j.simulator.parameters[i].estimate) << i;
    EXPECT_LT(j.simulator.parameters[i].value, j.drive.parameters[i].value) << i;
  }
  EXPECT_FALSE(j.in_simulator);
}

TEST(JointEffects, OfOneThatIsNotThereTheShapeIsHeld) {
  const JointEffect j = only_in_drive(sought("stribeck_friction", {0.02, 0.5, 0.1, 2.0}));
  EXPECT_TRUE(j.simulator.parameters[0].estimate);
  for (const std::size_t i : {1u, 2u, 3u}) EXPECT_FALSE(j.simulator.parameters[i].estimate) << i;
}

TEST(JointEffects, AnEffectIsAbsentWithAllThatSaysHowMuchThereIsOfIt) {
  EXPECT_FALSE(is_absent(sought("load_dependent_friction", {0.0, 0.29})));
  EXPECT_TRUE(is_absent(sought("load_dependent_friction", {0.0, 0.0})));
  EXPECT_FALSE(is_absent(sought("friction_asymmetry", {0.0, 0.3, 0.2})));
  EXPECT_TRUE(is_absent(sought("friction_asymmetry", {0.0, 0.3, 0.0}))) << "a share of no level is nothing";
  EXPECT_TRUE(is_absent(sought("stribeck_friction", {0.0, 0.5, 0.1, 2.0})));
  EXPECT_TRUE(is_absent(sought("cogging_torque", {0.0, 12.0, 0.4, 0.1, 0.0, 0.0, 0.0})));
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
