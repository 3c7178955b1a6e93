// `--set KEY=VALUE`: what is laid over a configuration, and who is told when it is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "config/setting.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using testing::kRecorded;
using testing::kSimulated;
using testing::with;

Configuration set_on(const std::string& text, const std::vector<std::string>& settings) {
  std::vector<Setting> all;
  for (const std::string& setting : settings) all.push_back(read_setting(setting));
  return parse_configuration(text, "c.yaml", all);
}

std::string refusal_of(const std::string& text, const std::vector<std::string>& settings) {
  try {
    set_on(text, settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(accepted)";
}

struct SameAs {
  const char* name;
  std::vector<std::string> settings;
  std::string text;  ///< of the configuration that says so itself
};

void PrintTo(const SameAs& same, std::ostream* out) { *out << same.name; }

class SameConfiguration : public ::testing::TestWithParam<SameAs> {};

TEST_P(SameConfiguration, AsIfItStoodInTheFile) {
  EXPECT_EQ(resolved_yaml(set_on(kRecorded, GetParam().settings)),
            resolved_yaml(parse_configuration(GetParam().text, "c.yaml")));
}

const std::string kWithEffect =
    with(kRecorded, "effects: []", "effects: [{motor_coulomb_friction: {level_nm: 0.02}}]");

const std::vector<SameAs> kSame = {
    {"nothing", {}, kRecorded},
    {"a_word",
     {"model.load=locked", "model.parameters.mass_ratio=1", "model.parameters.load_damping=0",
      "model.parameters.load_coulomb_friction=0"},
     with(with(with(with(kRecorded, "load: free", "load: locked"),
                    "mass_ratio: {value: 1.2, estimate: true, bounds: [0.05, 20]}", "mass_ratio: 1"),
               "load_damping: {value: 0.03, estimate: true, bounds: [0, 1]}", "load_damping: 0"),
          "load_coulomb_friction: {value: 0.05, estimate: true, bounds: [0, 1]}",
          "load_coulomb_friction: 0")},
    {"a_number_for_a_map",
     {"model.parameters.motor_damping=0.07"},
     with(kRecorded, "{value: 0.06, estimate: true, bounds: [0, 1]}", "0.07")},
    {"a_number_in_a_map", {"model.parameters.motor_damping.value=0.07"}, with(kRecorded, "0.06", "0.07")},
    {"a_list", {"recording.window=[1, 2]"}, with(kRecorded, "[0, 20.31]", "[1, 2]")},
    {"a_place_in_a_list", {"recording.window.0=1"}, with(kRecorded, "[0, 20.31]", "[1, 20.31]")},
    {"what_is_not_there", {"tolerance.torque_percent=2"}, kRecorded + "tolerance: {torque_percent: 2}\n"},
    {"a_map", {"tolerance={torque_percent: 2}"}, kRecorded + "tolerance: {torque_percent: 2}\n"},
    {"the_later_one", {"encoder.bits=12", "encoder.bits=16"}, with(kRecorded, "bits: 20", "bits: 16")},
    {"over_an_earlier_one",
     {"tolerance={torque_percent: 1, gap: 1e-3}", "tolerance.torque_percent=2"},
     kRecorded + "tolerance: {torque_percent: 2, gap: 1e-3}\n"},
    {"an_effect_that_is_not_there", {"model.effects.motor_coulomb_friction.level_nm=0.02"}, kWithEffect},
    {"a_first_effect", {"model.effects=[{motor_coulomb_friction: {level_nm: 0.02}}]"}, kWithEffect},
    {"an_equals_sign_in_the_value", {"recording.file=a=b.csv"}, with(kRecorded, "train.csv", "a=b.csv")},
};
INSTANTIATE_TEST_SUITE_P(Settings, SameConfiguration, ::testing::ValuesIn(kSame),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Setting, OfAnEffectIsNamedByTheEffectOrItsPlace) {
  for (const char* key : {"motor_coulomb_friction", "0.motor_coulomb_friction"}) {
    const Configuration c = set_on(kWithEffect, {std::string("model.effects.") + key + ".level_nm=0.03"});
    ASSERT_EQ(c.model.effects.size(), 1u);
    EXPECT_EQ(c.model.effects[0].effect.parameters[0].value, 0.03);
  }
}

TEST(Setting, LeavesWhatAnAliasSharesAsItWas) {
  const std::string text = with(with(kRecorded, "load_damping: {value: 0.03, estimate: true, bounds: [0, 1]}",
                                     "load_damping: *damping"),
                                "motor_damping: {", "motor_damping: &damping {");
  const Configuration c = set_on(text, {"model.parameters.load_damping.value=0.5"});
  EXPECT_EQ(c.model.parameters[drive_parameter_index("motor_damping")].value, 0.06);
  EXPECT_EQ(c.model.parameters[drive_parameter_index("load_damping")].value, 0.5);
}

struct BadSetting {
  const char* name;
  std::vector<std::string> settings;
  const char* message;  ///< begins with
};

void PrintTo(const BadSetting& bad, std::ostream* out) { *out << bad.name; }

class BadSettingTest : public ::testing::TestWithParam<BadSetting> {};

TEST_P(BadSettingTest, IsRefusedByItsKeyWithWhatWasExpected) {
  const std::string message = refusal_of(kRecorded, GetParam().settings);
  EXPECT_THAT(message, ::testing::StartsWith(GetParam().message));
  EXPECT_THAT(message, ::testing::HasSubstr("expected"));
}

const std::vector<BadSetting> kBadSettings = {
    {"no_value", {"model.load"}, "gapscope: --set is 'model.load', expected KEY=VALUE"},
    {"empty_value", {"model.load="}, "--set model.load: is empty, expected a value"},
    {"no_key", {"=1"}, "gapscope: --set is '=1', expected KEY=VALUE"},
    {"empty_key", {"model..load=free"}, "gapscope: --set has the key 'model..load', expected keys with dots"},
    {"long_key", {std::string(400, 'a') + "=1"}, "gapscope: --set has the key 'aaa"},
    {"syntax", {"model={a: ["}, "--set model: no valid YAML"},
    {"two_documents", {"name=a\n---\nb"}, "--set name: a second document"},
    {"unknown", {"modle.load=free"}, "--set modle.load: unknown key 'modle', expected model"},
    {"unknown_below",
     {"model.parameters.gapp=0.02"},
     "--set model.parameters.gapp: unknown key 'gapp' in model.parameters, expected gap"},
    {"unknown_in_the_value",
     {"tolerance={torque: 1}"},
     "--set tolerance: unknown key 'torque' in tolerance, expected one of torque_percent"},
    {"out_of_range",
     {"model.parameters.gap=-1"},
     "--set model.parameters.gap: model.parameters.gap is -1 rad"},
    {"wrong_word", {"name=a", "model.load=fixed"}, "--set model.load: model.load is 'fixed', expected free"},
    {"below_a_number",
     {"encoder.bits.x=1"},
     "--set encoder.bits.x: encoder.bits is '20', which holds no key"},
    {"no_place", {"recording.window.7=1"}, "--set recording.window.7: recording.window has 2 items"},
    {"unknown_effect",
     {"model.effects.cogging_torqe.amplitude_nm=1"},
     "--set model.effects.cogging_torqe.amplitude_nm: model.effects[0].cogging_torqe is no effect"},
    {"both_kinds_of_data",
     {"simulation={rate: 1000}"},
     "--set simulation: simulation stands beside recording"},
    {"found_out_at_the_end",
     {"detector.bound={from_model: {input_limit: 1, load_force_bound: 1}}",
      "model.parameters.mass_ratio={estimate: true}"},
     "--set detector.bound: detector.bound is from_model but mass_ratio is not known"},
};
INSTANTIATE_TEST_SUITE_P(Settings, BadSettingTest, ::testing::ValuesIn(kBadSettings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Setting, LeavesTheLinesOfTheFileAsTheyAre) {
  EXPECT_THAT(refusal_of(with(kRecorded, "    gap:", "    gapp:"), {"model.parameters.motor_damping=0.1"}),
              ::testing::StartsWith("c.yaml:18: unknown key 'gapp'"));
  EXPECT_THAT(refusal_of(with(kSimulated, "frequency: 2", "frequency: 600"), {"simulation.rate=1000"}),
              ::testing::StartsWith("c.yaml:5: "));
}

TEST(Setting, IsToldOfWhereAnErrorShowsLater) {
  const std::vector<Setting> settings = {read_setting("next_experiment.duration=3600")};
  const Configuration c = parse_configuration(kRecorded, "c.yaml", settings);
  try {
    telling_settings(settings, [&] { require_possible_experiment(c, 1e-5); });
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("--set next_experiment.duration: "));
  }
}

/// A diagnosis goes on from what another has found: the model of its fitted.yaml, and all else as it stands.
TEST(Setting, TakesTheModelOfAnotherConfiguration) {
  const testing::TemporaryFile other("name: other\n" + kWithEffect.substr(kWithEffect.find("model:")),
                                     "c.yaml");
  const auto resolved = [](const std::string& text, const std::vector<Setting>& settings) {
    return resolved_yaml(parse_configuration(text, "c.yaml", settings));
  };
  EXPECT_EQ(resolved(kRecorded, model_from(other.path())),
            resolved(with(kWithEffect, "level_nm: 0.02", "level_nm: {value: 0.02, estimate: true}"), {}))
      << "of an effect that the own model does not have the numbers are estimated";
  const std::string hung = with(kRecorded, "effects: []", "effects: []\nanchor: {mass: 0.5, arm: 0.1}");
  const testing::TemporaryFile fitted(
      "model: {parameters: {motor_inertia: 0.01, torque_constant: 1, mass_ratio: 0, motor_damping: 0}, effects: "
      "[{load_unbalance: {amplitude_nm: 0.49, phase_rad: 0}}]}",
      "c.yaml");
  EXPECT_FALSE(parse_configuration(hung, "c.yaml", model_from(fitted.path())).anchor)
      << "the fitted model has what is known of the drive in it";
  const testing::TemporaryFile found(
      "model: {parameters: {motor_inertia: 0.01, torque_constant: 0.9, mass_ratio: 0, motor_damping: 0.2}, "
      "effects: [{load_unbalance: {amplitude_nm: 0.49, phase_rad: 0}}, {motor_coulomb_friction: {level_nm: 0.02}}]}",
      "c.yaml");
  const std::string estimating =
      "name: c\nrecording: {file: a.csv}\nmodel: {parameters: {motor_damping: {estimate: true}, mass_ratio: 0}}\n"
      "anchor: {mass: 0.5, arm: 0.1}\n";
  const ReferenceModel going_on =
      parse_configuration(estimating, "c.yaml", model_from(found.path())).reference_model();
  for (const int place : {place::kMotorDamping, place::kTorqueConstant, place::kMotorInertia})
    EXPECT_TRUE(going_on.parameters[static_cast<std::size_t>(place)].estimate) << place;
  EXPECT_EQ(going_on.parameters[place::kMotorDamping].value, 0.2);
  ASSERT_EQ(going_on.effects.size(), 2u);
  EXPECT_FALSE(going_on.effects[0].parameters[0].estimate) << "known of the drive";
  EXPECT_TRUE(going_on.effects[1].parameters[0].estimate) << "found by a diagnosis";
  EXPECT_EQ(going_on.effects[1].parameters[0].value, 0.02);
  std::vector<Setting> held = model_from(found.path());
  held.push_back(read_setting("model.parameters.motor_damping=0.3"));
  const ReferenceModel set = parse_configuration(estimating, "c.yaml", held).reference_model();
  EXPECT_FALSE(set.parameters[place::kMotorDamping].estimate);
  EXPECT_EQ(set.parameters[place::kMotorDamping].value, 0.3);
  held.push_back(read_setting("model.effects.motor_coulomb_friction.level_nm=0.03"));
  const ReferenceModel with_level = parse_configuration(estimating, "c.yaml", held).reference_model();
  EXPECT_FALSE(with_level.effects[1].parameters[0].estimate) << "it was set";
  EXPECT_EQ(with_level.effects[1].parameters[0].value, 0.03);
  const testing::TemporaryFile bad("model: {parameters: {gapp: 1}}", "c.yaml"),
      none("name: other\n", "c.yaml");
  EXPECT_THROW(model_from(none.path()), ConfigError);
  try {
    resolved(kRecorded, model_from(bad.path()));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("--model-from " + bad.path() + ": model: "));
  }
}

}  // namespace
}  // namespace gapscope
