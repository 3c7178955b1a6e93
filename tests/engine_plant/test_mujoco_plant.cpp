// MuJoCo as the plant of a blind check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blind/case_plan.h"
#include "config/blind_config.h"
#include "engine_plant/mujoco_plant.h"
#include "independent_plant/severity.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

independent_plant::BlindCase two_seconds(const std::string& effect) {
  independent_plant::BlindCase c;
  c.options = {1000.0, 2.0, 5, independent_plant::kFastTolerance};
  c.excitation.frequency = 1.3;
  if (!effect.empty()) independent_plant::give_effect(c, effect, 0.6, 71);
  return c;
}

double largest_apart(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

class OfMujoco : public ::testing::TestWithParam<std::string> {};

/// Two plants without a line in common are within 0.005 mrad where both say the same law.
TEST_P(OfMujoco, MovesAsTheIndependentPlantDoes) {
  const independent_plant::BlindCase c = two_seconds(GetParam());
  const Recording by_mujoco = engine_plant::mujoco_recording(c);
  EXPECT_LT(largest_apart(by_mujoco.x1, independent_plant::simulate_blind(c).recording.x1), 5e-6);
  if (!GetParam().empty()) {
    EXPECT_GT(largest_apart(by_mujoco.x1, engine_plant::mujoco_recording(two_seconds("")).x1), 2e-4);
  }
}
INSTANTIATE_TEST_SUITE_P(Effects, OfMujoco,
                         ::testing::Values("", "motor_coulomb_friction", "input_delay", "actuator_lag",
                                           "load_unbalance", "constant_load_torque", "shaft_compliance",
                                           "impact_damping"));

TEST(PlantOfMujoco, RefusesWhatItsXmlDoesNotSay) {
  EXPECT_THROW(engine_plant::mujoco_recording(two_seconds("cogging_torque")), std::logic_error);
}

TEST(PlantOfMujoco, GivesItsCasesEffectsThatItsXmlSays) {
  const testing::TemporaryFile file("name: m\nplant: mujoco\nreport: {first_seed: 7, known: 20, none: 2}\n",
                                    "check.yaml");
  for (const blind::PlannedCase& c : blind::plan_cases(load_blind_config(file.path())))
    for (const std::string& effect : c.label.effects)
      EXPECT_EQ(std::ranges::count(engine_plant::mujoco_effects(), effect), 1) << effect;
  const testing::TemporaryFile outside("name: m\nplant: mujoco\nreport: {first_seed: 7, outside: 2}\n",
                                       "check.yaml");
  EXPECT_THAT(testing::refusal([&] { load_blind_config(outside.path()); }),
              HasSubstr(":3: report has 2 cases outside of the catalogue"));
}

}  // namespace
}  // namespace gapscope
