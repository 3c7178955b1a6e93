// Every row of the catalogue can be written in a configuration: a new effect is tested by being there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config/texts.h"
#include "gapscope/base/errors.h"
#include "gapscope/config/configuration.h"

namespace gapscope {
namespace {

using testing::kRecorded;
using testing::kSimulated;
using testing::with;

/// "{name: {key: value, …}}" with values within any drive's bounds.
std::string written(const EffectEntry& e) {
  std::string keys;
  for (const EffectParameterSpec& p : e.parameters) {
    const double v = p.scale == Scale::kOne ? 0.5 * (p.low + p.high) : 0.01;
    keys += (keys.empty() ? "" : ", ") + std::string(p.key) + ": " + std::to_string(v);
  }
  return "{" + std::string(e.name) + ": {" + keys + "}}";
}

class EveryEffect : public ::testing::TestWithParam<std::string> {
 protected:
  const EffectEntry& entry() const { return *find_effect(GetParam()); }
};

/// Of the whole catalogue.
std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const EffectEntry* e : effect_table()) all.emplace_back(e->name);
  return all;
}

TEST_P(EveryEffect, SurvivesTheRoundTripThroughAResolvedConfiguration) {
  const Configuration c =
      parse_configuration(with(kRecorded, "effects: []", "effects: [" + written(entry()) + "]"), "c.yaml");
  ASSERT_EQ(c.model.effects.size(), 1u);
  const std::string resolved = resolved_yaml(c);
  const Configuration again = parse_configuration(resolved, "c.yaml");
  ASSERT_EQ(again.model.effects.size(), 1u);
  EXPECT_EQ(again.model.effects[0].effect.entry, &entry());
  for (std::size_t i = 0; i < entry().parameters.size(); ++i)
    EXPECT_EQ(again.model.effects[0].effect.parameters[i].value,
              c.model.effects[0].effect.parameters[i].value);
  EXPECT_EQ(resolved_yaml(again), resolved);
}

TEST_P(EveryEffect, CanBeEstimatedWithBounds) {
  const EffectParameterSpec& p = entry().parameters[0];
  std::string text = written(entry());
  const std::size_t begin = text.find(": ", text.find(p.key)) + 2;
  text.replace(begin, text.find_first_of(",}", begin) - begin,
               "{value: 0.01, estimate: true, bounds: [0, 0.5]}");
  const Configuration c =
      parse_configuration(with(kRecorded, "effects: []", "effects: [" + text + "]"), "c.yaml");
  const ReferenceModel model = c.model.reference_model();
  const ParameterSetting& setting = model.effects[0].parameters[0];
  EXPECT_TRUE(setting.estimate);
  EXPECT_EQ(setting.high, 0.5);
}

TEST_P(EveryEffect, RefusesAKeyThatItDoesNotHave) {
  const std::string text = "{" + std::string(entry().name) + ": {no_such_key: 1}}";
  try {
    parse_configuration(with(kRecorded, "effects: []", "effects: [" + text + "]"), "c.yaml");
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("c.yaml:23: unknown key 'no_such_key'"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr(entry().parameters[0].key));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, ::testing::ValuesIn(names()),
                         [](const auto& row) { return row.param; });

TEST(Effects, OfTheSimulatedPlantAreNotThoseOfTheModel) {
  const Configuration c = parse_configuration(
      with(kSimulated, "  excitation",
           "  model: {effects: [{motor_coulomb_friction: {level_nm: 0.01}}]}\n  excitation"),
      "c.yaml");
  EXPECT_TRUE(c.model.effects.empty());
  const PlantModel<double> plant = c.simulation->plant.plant_model();
  EXPECT_TRUE(plant.motor_sticks);
  EXPECT_EQ(plant.motor_friction_plus, 0.01);
}

}  // namespace
}  // namespace gapscope
