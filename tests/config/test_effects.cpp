// Every row of the catalogue can be written in a configuration: a new effect is tested by being there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config/configuration.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"

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

const char* const kCogging = "effects: [{cogging_torque: {amplitude_nm: 0.1, ";

ParameterSetting period_of(const std::string& text) {
  const Configuration c = parse_configuration(text, "c.yaml");
  const ModelEffect& effect = c.model.effects.at(0).effect;
  return effect.parameters.at(static_cast<std::size_t>(effect.entry->period_at()));
}

std::string with_period(const std::string& written) {
  return with(kRecorded, "effects: []", kCogging + written + "}}]");
}

TEST(Periods, MayBeWrittenAsALengthWithBoundsAndToBeEstimated) {
  EXPECT_EQ(period_of(with_period("period_rad: 0.25")).value, 8.0 * std::numbers::pi);
  const ParameterSetting p =
      period_of(with_period("period_rad: {value: 0.25, estimate: true, bounds: [0.2, 0.5]}"));
  EXPECT_TRUE(p.estimate);
  EXPECT_EQ(p.value, 8.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(p.low, 4.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(p.high, 10.0 * std::numbers::pi);
}

std::string refusal_of(const std::string& text) {
  try {
    parse_configuration(text, "c.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Periods, AreWrittenInOneWayAndNotForgotten) {
  EXPECT_THAT(refusal_of(with_period("period_rad: 0.25, periods_per_turn: 24")),
              ::testing::HasSubstr("stands beside periods_per_turn"));
  EXPECT_THAT(refusal_of(with_period("phase_rad: 0.25")), ::testing::HasSubstr("or period_rad"));
  EXPECT_THAT(refusal_of(with_period("period_rad: 0")), ::testing::HasSubstr("c.yaml:23"));
}

const std::string kOnce = with(kRecorded, "effects: []", "effects: [{load_unbalance: {amplitude_nm: 0.1}}]");

TEST(Periods, OncePerTurnIsOfTheShaftThatTheGearRatioTells) {
  EXPECT_EQ(period_of(kOnce).value, 1.0);
  const std::string gear = "recording:\n  gear_ratio: {position: -10, load_position: 0.25}";
  EXPECT_EQ(period_of(with(kOnce, "recording:", gear)).value, 0.25);
  const std::string eccentric =
      with(kOnce, "load_unbalance: {amplitude_nm", "encoder_eccentricity: {amplitude_rad");
  EXPECT_EQ(period_of(with(eccentric, "recording:", gear)).value, 10.0);
  const DiagnosisOptions options =
      diagnosis_options(parse_configuration(with(kOnce, "recording:", gear), "c"));
  EXPECT_EQ(options.turns.motor, 10.0);
  EXPECT_EQ(options.turns.load, 0.25);
}

TEST(Periods, OfASlideAreLengthsAndNeverOncePerTwoPiMetres) {
  const std::string slide =
      with(with(kOnce, "coordinates: rotation", "coordinates: translation"), "bits: 20", "quantum: 1e-6");
  EXPECT_THAT(refusal_of(slide), ::testing::HasSubstr("expected period_rad [m]"));
  const std::string screw = with(slide, "amplitude_nm: 0.1", "amplitude_nm: 0.1, period_rad: 2.5e-3");
  EXPECT_EQ(period_of(screw).value, 2.0 * std::numbers::pi / 2.5e-3);
  const std::string resolved = resolved_yaml(parse_configuration(screw, "c.yaml"));
  EXPECT_THAT(resolved, ::testing::HasSubstr("period_rad: 0.0025}"));
  const Configuration again = parse_configuration(resolved, "c.yaml");
  EXPECT_NEAR(again.model.effects[0].effect.parameters[2].value * 2.5e-3 / (2.0 * std::numbers::pi), 1.0,
              1e-14);
  EXPECT_EQ(resolved_yaml(again), resolved);
  EXPECT_TRUE(std::isnan(diagnosis_options(again).turns.load));
}

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
