#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kRecorded;
using testing::kSimulated;
using testing::with;

std::string refusal(const std::string& text) {
  try {
    parse_configuration(text, "c.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(accepted)";
}

struct BadConfig {
  const char* name;
  std::string text;
  const char* message;  ///< begins with the place
};

void PrintTo(const BadConfig& bad, std::ostream* out) { *out << bad.name; }

class BadConfigTest : public ::testing::TestWithParam<BadConfig> {};

TEST_P(BadConfigTest, IsRefusedWithPlaceAndExpectation) {
  const std::string message = refusal(GetParam().text);
  EXPECT_THAT(message, ::testing::StartsWith(GetParam().message));
  EXPECT_THAT(message, HasSubstr("expected"));
}

std::string recorded(const std::string& what, const std::string& by) { return with(kRecorded, what, by); }
std::string simulated(const std::string& what, const std::string& by) { return with(kSimulated, what, by); }

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

const std::vector<BadConfig> kBadDocuments = {
    {"empty", "", "c.yaml: is empty"},
    {"comment_only", "# nothing\n", "c.yaml: is empty"},
    {"list", "- a\n- b\n", "c.yaml:1: the file is a list"},
    {"text", "hello\n", "c.yaml:1: the file is 'hello'"},
    {"syntax", "name: a\nmodel: {parameters: [1\nload: 2\n", "c.yaml:3: no valid YAML"},
    {"tab", "name: a\nmodel:\n\tload: free\n", "c.yaml:3: no valid YAML"},
    {"odd_escape", "name: \"a\\\nb\"\nmodel: \"\\\t\\\x01\"\n", "c.yaml:"},
    {"unknown_alias", "name: *x\n", "c.yaml:1: no valid YAML"},
    {"two_documents", kRecorded + "---\nname: b\n", "c.yaml:25: a second document begins"},
    {"deep", "name: " + std::string(60, '[') + std::string(60, ']'), "c.yaml:1: nested too deep"},
    {"many_values", "name: [" + repeated("0, ", 30000) + "0]", "c.yaml:1: too many values"},
    {"unknown_key", kRecorded + "enocder: {bits: 20}\n",
     "c.yaml:25: unknown key 'enocder', expected encoder"},
    {"unknown_nested", recorded("    gap:", "    gapp:"),
     "c.yaml:18: unknown key 'gapp' in model.parameters, expected gap"},
    {"repeated_key", kRecorded + "name: b\n", "c.yaml:25: the key 'name' is there twice"},
    {"repeated_nested", recorded("contact_damping", "contact_stiffness"),
     "c.yaml:22: the key 'contact_stiffness'"},
    {"name_with_slash", recorded("rig_p", "../rig"),
     "c.yaml:1: name is '../rig', expected a plain folder name"},
    {"name_dots", recorded("rig_p", ".."), "c.yaml:1: name is '..'"},
    {"name_empty", recorded("rig_p", "\"\""), "c.yaml:1: name is an empty text"},
    {"name_null", recorded("rig_p", ""), "c.yaml:1: name is empty"},
    {"coordinates", recorded("rotation", "polar"),
     "c.yaml:9: coordinates is 'polar', expected rotation or translation"},
};

const std::vector<BadConfig> kBadData = {
    {"neither", "name: a\nmodel: {}\n",
     "c.yaml:1: there is no recording, expected either recording or simulation"},
    {"unknown_plant", with(kSimulated, "  rate: 1000\n", "  rate: 1000\n  plant: mine\n"),
     "c.yaml:4: simulation.plant is 'mine', expected simulator or independent"},
    {"independent_with_effects",
     with(kSimulated, "  rate: 1000\n", "  rate: 1000\n  plant: independent\n") +
         "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}, {input_delay: {delay_s: 1.0e-3}}]\n",
     "c.yaml:15: simulation.plant is independent, which has no input_delay, expected contact_adhesion, "},
    {"both", kSimulated + "recording: {file: a.csv}\n",
     "c.yaml:2: simulation stands beside recording (line 14)"},
    {"no_file", "name: a\nrecording: {window: [0, 1]}\n", "c.yaml:2: recording has no file"},
    {"no_map", "name: a\nrecording: a.csv\n", "c.yaml:2: recording is 'a.csv', expected a map"},
    {"null_section", "name: a\nrecording:\n", "c.yaml:2: recording is empty, expected a map"},
    {"file_twice", recorded("[a.csv, b.csv]", "[a.csv, ./train.csv]"),
     "c.yaml:4: recording.held_out[1] names ./train.csv"},
    {"simulated_of_another_number", with(kRecorded, "  resample", "  simulated: [s.csv, t.csv]\n  resample"),
     "c.yaml:7: recording.simulated names 2 files, expected one for each of recording: file (1), and for each "
     "of held_out (2) behind them"},
    {"simulated_is_recorded", with(kRecorded, "  resample", "  simulated: ./train.csv\n  resample"),
     "c.yaml:7: recording.simulated names ./train.csv, which is named already"},
    {"no_files", recorded("train.csv", "[]"), "c.yaml:3: recording.file is an empty list"},
    {"column_twice", recorded("input: u", "input: x1"),
     "c.yaml:5: recording.columns.position uses the column x1 twice"},
    {"temperature_as_input", recorded("input: u", "input: motor_temp"),
     "c.yaml:5: recording.columns.input is 'motor_temp', a temperature by its name, expected the column of a"},
    {"unknown_unit", with(kRecorded, "  resample", "  units: {position: degree}\n  resample"),
     "c.yaml:7: recording.units.position is 'degree', expected rad, mrad, deg, arcmin, rev, arcsec, or a number"},
    {"unit_of_a_slide", with(kRecorded, "  resample", "  units: {time: m}\n  resample"),
     "c.yaml:7: recording.units.time is 'm', expected s, ms"},
    {"unit_of_no_column", with(kRecorded, "  resample", "  units: {x1: deg}\n  resample"),
     "c.yaml:7: unknown key 'x1' in recording.units"},
    {"unit_not_above_zero", with(kRecorded, "  resample", "  units: {input: 0}\n  resample"),
     "c.yaml:7: recording.units.input is '0', expected N m, mN m"},
    {"unit_list", with(kRecorded, "  resample", "  units: {input: [A]}\n  resample"),
     "c.yaml:7: recording.units.input is a list"},
    {"counts_of_nothing", "name: a\nrecording: {file: a.csv, units: {position: counts}}\n",
     "c.yaml:2: recording.units.position is 'counts', expected encoder: {bits: ...}"},
    {"counts_of_the_load", with(kRecorded, "  resample", "  units: {load_position: counts}\n  resample"),
     "c.yaml:7: recording.units.load_position is 'counts', expected rad"},
    {"gear_of_nothing", with(kRecorded, "  resample", "  gear_ratio: {position: 0}\n  resample"),
     "c.yaml:7: recording.gear_ratio is a map, expected turns of the recorded axis"},
    {"gear_without_column", with(kRecorded, "  resample", "  gear_ratio: 50\n  resample"),
     "c.yaml:7: recording.gear_ratio is '50', expected a map"},
    {"window_reversed", recorded("[0, 20.31]", "[9, 3]"),
     "c.yaml:6: recording.window is [9, 3], expected [low, high]"},
    {"window_three", recorded("[0, 20.31]", "[1, 2, 3]"), "c.yaml:6: recording.window has 3 numbers"},
    {"resample_for_whom", recorded("{rate: 400}", "{rate: 400, for: fit}"),
     "c.yaml:7: recording.resample.for is 'fit'"},
    {"rate_zero", recorded("400", "0"), "c.yaml:7: recording.resample.rate is 0 Hz"},
    {"bits_text", recorded("20}", "twenty}"),
     "c.yaml:8: encoder.bits is 'twenty', expected a whole number from 1 to 40"},
    {"bits_and_quantum", recorded("20}", "20, quantum: 1e-6}"),
     "c.yaml:8: encoder has both of bits and quantum"},
    {"bits_of_a_slide", recorded("rotation", "translation"), "c.yaml:8: encoder.bits counts a revolution"},
    {"no_rate", simulated("  rate: 1000\n", ""), "c.yaml:2: simulation has no rate"},
    {"rate_quoted", simulated("1000", "\"1000\""), "c.yaml:3: simulation.rate is the text '1000'"},
    {"too_many_samples", simulated("duration: 1", "duration: 1e6"),
     "c.yaml:2: simulation gives rate x duration = 1e+09"},
    {"too_few_samples", simulated("duration: 1", "duration: 0.01"),
     "c.yaml:2: simulation gives rate x duration = 10"},
    {"negative_seed", simulated("duration: 1", "duration: 1\n  seed: -1"),
     "c.yaml:5: simulation.seed is '-1'"},
    {"no_excitation", simulated("{sine: {amplitude: 0.5, frequency: 2}}", "{}"),
     "c.yaml:5: simulation.excitation"},
    {"unknown_excitation", simulated("sine", "sinus"),
     "c.yaml:5: unknown key 'sinus' in simulation.excitation, expected sine"},
    {"two_excitations", simulated("2}}", "2}, steps: {amplitude: 1, hold: 1}}"),
     "c.yaml:5: simulation.excitation.steps"},
    {"no_frequency", simulated(", frequency: 2", ""),
     "c.yaml:5: simulation.excitation.sine has no frequency"},
    {"frequency_nan", simulated("frequency: 2", "frequency: nan"),
     "c.yaml:5: simulation.excitation.sine.frequency is nan"},
    {"above_nyquist", simulated("frequency: 2", "frequency: 500"),
     "c.yaml:5: simulation.excitation sine: frequency"},
    {"no_plant", simulated("    gap: 0.02\n", ""),
     "c.yaml:2: simulation has no gap, expected a number [rad]"},
    {"rigid_start",
     simulated("model:\n", "  initial: {x1: 1}\nmodel:\n  contact: {rigid: {restitution: 1}}\n"),
     "c.yaml:2: simulation.initial"},
};

const std::vector<BadConfig> kBadModels = {
    {"gap_negative", recorded("value: 0.02", "value: -0.01"),
     "c.yaml:18: model.parameters.gap.value is -0.01 rad, expected 0 to 0.3 rad"},
    {"gap_negative_fixed", simulated("gap: 0.02", "gap: -0.01"),
     "c.yaml:12: model.parameters.gap is -0.01 rad"},
    {"outside_bounds", recorded("value: 1.2", "value: 21"),
     "c.yaml:17: model.parameters.mass_ratio.value is 21, expected 0.05 to 20"},
    {"bounds_reversed", recorded("[0.05, 20]", "[20, 0.05]"),
     "c.yaml:17: model.parameters.mass_ratio.bounds is [20, 0.05]"},
    {"bounds_one", recorded("[0.05, 20]", "[20]"),
     "c.yaml:17: model.parameters.mass_ratio.bounds has 1 numbers"},
    {"inertia_zero", recorded("8.78e-4", "0"), "c.yaml:14: model.parameters.motor_inertia is 0 kg m^2"},
    {"inertia_word", recorded("8.78e-4", "small"),
     "c.yaml:14: model.parameters.motor_inertia is 'small', expected a number"},
    {"inertia_infinite", recorded("8.78e-4", "inf"), "c.yaml:14: model.parameters.motor_inertia is inf"},
    {"estimate_word", recorded("estimate: true", "estimate: yes"),
     "c.yaml:16: model.parameters.motor_damping.estimate is 'yes'"},
    {"no_value", recorded("200", "{estimate: false}"),
     "c.yaml:21: model.parameters.contact_stiffness has no value"},
    {"prior_of_fixed", recorded("200", "{value: 200, prior: {std: 1}}"),
     "c.yaml:21: model.parameters.contact_stiffness has a prior"},
    {"ratio_starts_at_zero",
     recorded("{value: 1.2, estimate: true, bounds: [0.05, 20]}", "{value: 0, estimate: true}"),
     "c.yaml:17: model.parameters.mass_ratio starts at 0"},
    {"ratio_next_to_zero", simulated("mass_ratio: 2", "mass_ratio: 1e-9"),
     "c.yaml:11: model.parameters.mass_ratio is 1e-09, expected 0 (no load) or at least 0.001"},
    {"no_load_gap", recorded("{value: 1.2, estimate: true, bounds: [0.05, 20]}", "0"),
     "c.yaml:18: model.parameters.gap is estimated"},
    {"locked_ratio", recorded("load: free", "load: locked"),
     "c.yaml:17: model.parameters.mass_ratio is estimated"},
    {"locked_without_load",
     simulated("parameters:\n", "load: locked\n  parameters:\n")
         .replace(kSimulated.find("mass_ratio: 2") + 15, 13, "mass_ratio: 0"),
     "c.yaml:12: model.parameters.mass_ratio is 0"},
    {"rigid_stiffness",
     recorded("200", "{value: 200, estimate: true}")
         .replace(kRecorded.find("compliant"), 9, "{rigid: {restitution: 0.5}}"),
     "c.yaml:21: model.parameters.contact_stiffness is estimated"},
    {"contact", recorded("compliant", "soft"), "c.yaml:11: model.contact is 'soft'"},
    {"restitution", recorded("compliant", "{rigid: {restitution: 1.5}}"),
     "c.yaml:11: model.contact.rigid.restitution is 1.5"},
    {"load", recorded("load: free", "load: stuck"),
     "c.yaml:12: model.load is 'stuck', expected free or locked"},
    {"effect", recorded("effects: []", "effects: [{stribeck_friction: {level_nm: 1}}]"),
     "c.yaml:23: model.effects[0].stribeck_friction has no stribeck_speed_rad_s, expected a number in rad/s"},
    {"effect_unknown", recorded("effects: []", "effects: [{coging_torque: {amplitude_nm: 1}}]"),
     "c.yaml:23: model.effects[0].coging_torque is no effect of the catalogue, expected one of `gapscope effects`; "
     "the nearest is cogging_torque"},
    {"effect_key", recorded("effects: []", "effects: [{load_unbalance: {amplitude: 1}}]"),
     "c.yaml:23: unknown key 'amplitude' in model.effects[0].load_unbalance, expected amplitude_nm"},
    {"effect_negative", recorded("effects: []", "effects: [{motor_coulomb_friction: {level_nm: -1}}]"),
     "c.yaml:23: model.effects[0].motor_coulomb_friction.level_nm is -1"},
    {"effect_form", recorded("effects: []", "effects: [stribeck_friction]"),
     "c.yaml:23: model.effects[0] is 'stribeck_friction'"},
    {"effect_alone_unknown", recorded("effects: []", "effects: [coulomb_friction]"),
     "c.yaml:23: model.effects[0] is no effect of the catalogue, expected one of `gapscope effects`; the nearest "
     "is motor_coulomb_friction"},
    {"excluded", kRecorded + "diagnosis: {exclude: [load_unbalance, coging_torque]}\n",
     "c.yaml:25: diagnosis.exclude[1] is no effect of the catalogue, expected one of `gapscope effects`; the "
     "nearest is cogging_torque"},
    {"bound_word", recorded("auto", "automatic"),
     "c.yaml:24: detector.bound is 'automatic', expected a number"},
    {"bound_negative", recorded("auto", "-3"), "c.yaml:24: detector.bound is -3 rad/s^2"},
    {"bound_keys", recorded("auto", "{from_model: {input_limit: 1}}"),
     "c.yaml:24: detector.bound.from_model has no load_force_bound"},
    {"bound_without_model",
     "name: a\nrecording: {file: a.csv}\ndetector: {bound: {from_model: {input_limit: 1, load_force_bound: 0}}}\n",
     "c.yaml:3: detector.bound is from_model but motor_inertia is not known"},
};

const auto kName = [](const auto& tested) { return std::string(tested.param.name); };
INSTANTIATE_TEST_SUITE_P(Document, BadConfigTest, ::testing::ValuesIn(kBadDocuments), kName);
INSTANTIATE_TEST_SUITE_P(Data, BadConfigTest, ::testing::ValuesIn(kBadData), kName);
INSTANTIATE_TEST_SUITE_P(Model, BadConfigTest, ::testing::ValuesIn(kBadModels), kName);

TEST(BadConfig, AnAliasThatContainsItselfIsRefused) {
  EXPECT_THAT(refusal("name: a\nrecording: &r {file: [*r]}\n"),
              HasSubstr("c.yaml:2: an alias stands within what it stands for, expected it after that"));
}

TEST(BadConfig, AliasesOfAliasesCountAsWhatTheyStandFor) {
  std::string bomb = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 30; ++i)
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + ", *a" +
            std::to_string(i - 1) + "]\n";
  EXPECT_THAT(refusal(bomb), HasSubstr("c.yaml:13: too many values, expected at most 20000"));
}

TEST(BadConfig, AnExperimentThatWouldNotFitIsRefusedWithItsNumber) {
  const Configuration c = parse_configuration(kRecorded + "next_experiment: {duration: 3600}\n", "c.yaml");
  require_possible_experiment(c, 1e-3);
  try {
    require_possible_experiment(c, 1e-5);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("c.yaml:25: next_experiment.duration is 3600 s, 3.6e+08 samples at the "
                          "1e+05 Hz of the recording, expected at most 2e+07"));
  }
}

TEST(BadConfig, FilesThatAreNoConfigurationAreRefused) {
  const auto load = [](const std::string& path) -> std::string {
    try {
      load_configuration(path);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "(accepted)";
  };
  const testing::TemporaryFile large(std::string((1u << 20) + 1, '#'), "large.yaml");
  const testing::TemporaryFile binary(std::string("name\0: a", 8), "binary.yaml");
  EXPECT_THAT(load(large.path()), HasSubstr("large.yaml: is larger than 1 MiB"));
  EXPECT_THAT(load(binary.path()), HasSubstr("binary.yaml: is no text"));
  EXPECT_THAT(load(large.path() + "x"), HasSubstr("there is no such file"));
  EXPECT_THAT(load(large.folder().string()), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace gapscope
