#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "config/blind_config.h"
#include "config/configuration.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using testing::kRecorded;
using testing::kSimulated;
using testing::with;

const ParameterSetting& parameter(const Configuration& c, const char* key) {
  return c.model.parameters[drive_parameter_index(key)];
}

TEST(Configuration, AResamplingForTheDetectorLeavesFitAndDiagnoseTheRowsAsTheyAre) {
  const Configuration all = parse_configuration(kRecorded, "rig.yaml");
  EXPECT_EQ(all.recording->reading_for(UnevenRows::kStamped).resample_rate, 400.0);
  const std::string own = with(kRecorded, "{rate: 400}", "{rate: 400, for: detector}");
  const Configuration c = parse_configuration(own, "rig.yaml");
  EXPECT_EQ(c.recording->reading_for(UnevenRows::kRefused).resample_rate, 400.0);
  const ReadOptions as_it_is = c.recording->reading_for(UnevenRows::kStamped);
  EXPECT_FALSE(as_it_is.resample_rate);
  EXPECT_EQ(as_it_is.uneven, UnevenRows::kStamped);
  EXPECT_NE(resolved_yaml(c).find("resample: {rate: 400, for: detector}"), std::string::npos);
}

TEST(Configuration, NamesWhatASimulatorAnswersAndWritesItBack) {
  std::string text = kRecorded;
  text.replace(text.find("  resample"), 0, "  simulated: [s.csv, a_s.csv, b_s.csv]\n");
  const Configuration c = parse_configuration(text, "configs/rig.yaml");
  ASSERT_EQ(c.recording->simulated.size(), 3u);
  EXPECT_EQ(c.recording->simulated[0].path, "configs/s.csv");
  EXPECT_EQ(c.recording->simulated[2].line, 7);
  const Configuration again = parse_configuration(resolved_yaml(c), "configs/rig.yaml");
  EXPECT_EQ(again.recording->simulated.size(), 3u);
}

TEST(Configuration, EveryKeyOfTheSchemaArrives) {
  const Configuration c = parse_configuration(kRecorded, "configs/rig.yaml");
  EXPECT_EQ(c.name, "rig_p");
  ASSERT_TRUE(c.recording.has_value());
  EXPECT_FALSE(c.simulation.has_value());
  EXPECT_EQ(c.recording->files.at(0).path, "configs/train.csv");
  EXPECT_EQ(c.recording->files.at(0).given, "train.csv");
  EXPECT_EQ(c.recording->files.at(0).line, 3);
  EXPECT_EQ(c.recording->held_out.size(), 2u);
  EXPECT_TRUE(c.recording->reading.columns.load_position_required);
  EXPECT_EQ(c.recording->reading.window->second, 20.31);
  EXPECT_EQ(c.recording->reading.resample_rate, 400.0);
  EXPECT_DOUBLE_EQ(c.encoder.quantum, 2.0 * kPi / 1048576.0);
  EXPECT_EQ(c.coordinates, Coordinates::kRotation);
  EXPECT_EQ(c.model.structure.contact, ContactLaw::kCompliant);
  EXPECT_EQ(parameter(c, "motor_inertia").value, 8.78e-4);
  EXPECT_FALSE(parameter(c, "motor_inertia").estimate);
  EXPECT_TRUE(parameter(c, "gap").estimate);
  EXPECT_EQ(parameter(c, "gap").high, 0.3);
  EXPECT_EQ(parameter(c, "gap").prior->value, 0.02);
  EXPECT_EQ(parameter(c, "gap").prior->std, 0.01);
  EXPECT_FALSE(c.detector.bound.has_value());
  EXPECT_FALSE(c.detector.from_model.has_value());
  EXPECT_NO_THROW(require_reference_model(c));
}

TEST(Configuration, UnitsAndGearsMakeSiOfTheColumnsAndOfTheEncodersStep) {
  const std::string units =
      "  units: {time: ms, input: mN m, position: counts, load_position: 1.5e-3}\n"
      "  gear_ratio: {position: -50}\n  resample";
  const Configuration c = parse_configuration(with(kRecorded, "  resample", units), "rig.yaml");
  const ColumnScales& s = c.recording->reading.columns.scales;
  EXPECT_EQ(s.time(7.0), 0.007);
  EXPECT_EQ(s.input(5.0), 0.005);
  EXPECT_DOUBLE_EQ(s.position(1048576.0), -2.0 * kPi / 50.0);  // a turn of the encoder
  EXPECT_EQ(s.load_position(2.0), 0.003);
  EXPECT_DOUBLE_EQ(c.encoder.quantum, 2.0 * kPi / 1048576.0);  // as on its sheet
  EXPECT_DOUBLE_EQ(c.position_quantum(), 2.0 * kPi / 1048576.0 / 50.0);
  const std::string resolved = resolved_yaml(c);
  EXPECT_THAT(resolved, ::testing::HasSubstr("gear_ratio: {position: -50, load_position: 1}"));
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved, "rig.yaml")), resolved);
}

TEST(Configuration, ADutyOfARegisterAndAVoltageAreDeclared) {
  const std::string declared = "  units: {input: '%', voltage: mV}\n  registers: {input: 16}\n  resample";
  const std::string text =
      with(with(kRecorded, "  resample", declared), "columns: {", "columns: {voltage: volts, ");
  const Configuration c = parse_configuration(text, "rig.yaml");
  const RecordingColumns& columns = c.recording->reading.columns;
  EXPECT_EQ(columns.voltage, "volts");
  EXPECT_EQ(columns.scales.input(65436.0), -1.0);
  EXPECT_EQ(columns.scales.voltage(7400.0), 7.4);
  const std::string resolved = resolved_yaml(c);
  EXPECT_THAT(resolved, ::testing::HasSubstr("registers: {input: 16}"));
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved, "rig.yaml")), resolved);
}

TEST(Configuration, WithoutUnitsColumnsStayAsTheyAre) {
  const Configuration c = parse_configuration(kRecorded, "rig.yaml");
  const ColumnScales& s = c.recording->reading.columns.scales;
  for (const UnitScale& scale : {s.time, s.input, s.position, s.load_position}) EXPECT_EQ(scale(0.1), 0.1);
  EXPECT_EQ(resolved_yaml(c).find("units:"), std::string::npos);
}

TEST(Configuration, GapMotorDampingAndMassRatioAreEstimatedWhenTheirKeysAreAbsent) {
  const Configuration c = parse_configuration(
      "recording: {file: a.csv}\n"
      "model: {parameters: {motor_inertia: 1, torque_constant: 1, contact_stiffness: 100}}\n",
      "rig.yaml");
  EXPECT_EQ(c.name, "rig");
  for (const char* key : {"gap", "motor_damping", "mass_ratio"}) {
    EXPECT_TRUE(parameter(c, key).estimate) << key;
    EXPECT_TRUE(std::isnan(parameter(c, key).value)) << key;  // the fit finds its own start
    EXPECT_TRUE(std::isnan(parameter(c, key).low)) << key;
  }
  EXPECT_EQ(parameter(c, "load_damping").value, 0.0);
  EXPECT_TRUE(c.model.defaulted[drive_parameter_index("load_damping")]);
  EXPECT_NO_THROW(require_reference_model(c));
}

TEST(Configuration, AFitNeedsInertiaTorqueConstantAndStiffnessUnlessEstimated) {
  const auto require = [](const std::string& parameters) {
    require_reference_model(parse_configuration(
        "name: a\nrecording: {file: a.csv}\nmodel: {parameters: {" + parameters + "}}\n", "a.yaml"));
  };
  EXPECT_THROW(require("torque_constant: 1, contact_stiffness: 1"), ConfigError);
  EXPECT_THROW(require("motor_inertia: 1, contact_stiffness: 1"), ConfigError);
  EXPECT_THROW(require("motor_inertia: 1, torque_constant: 1"), ConfigError);
  EXPECT_NO_THROW(require("motor_inertia: {estimate: true}, torque_constant: 1, contact_stiffness: 1"));
  EXPECT_NO_THROW(require("motor_inertia: 1, torque_constant: 1, mass_ratio: 0"));
  EXPECT_THROW(require_reference_model(parse_configuration("name: a\nrecording: {file: a.csv}\n", "a.yaml")),
               ConfigError);
}

TEST(Configuration, AMassRatioOfZeroIsOneInertiaWithoutGap) {
  const Configuration c = parse_configuration(with(kSimulated, "mass_ratio: 2", "mass_ratio: 0"), "a.yaml");
  EXPECT_FALSE(c.model.structure.has_load);
  for (int i = 3; i < kDriveParameterCount; ++i) EXPECT_FALSE(c.model.parameters[i].estimate);
  EXPECT_TRUE(
      parse_configuration("name: a\nrecording: {file: a.csv}\nmodel: {parameters: {mass_ratio: 0}}", "a")
          .model.parameters[drive_parameter_index("motor_damping")]
          .estimate);
}

TEST(Configuration, ALockedLoadHasNoMassRatioToEstimate) {
  const Configuration c = parse_configuration(
      "name: a\nrecording: {file: a.csv}\nmodel: {load: locked, parameters: {motor_inertia: 1, "
      "torque_constant: 1, "
      "contact_stiffness: 9}}\n",
      "a.yaml");
  EXPECT_EQ(c.model.structure.load, LoadKind::kLocked);
  EXPECT_FALSE(parameter(c, "mass_ratio").estimate);
  EXPECT_TRUE(parameter(c, "gap").estimate);
  EXPECT_NO_THROW(require_reference_model(c));
}

TEST(Configuration, TheSimulatedPlantIsTheModelWithItsChanges) {
  const std::string text = with(kSimulated, "model:\n",
                                "  model: {contact: {rigid: {restitution: 0.8}}, parameters: {gap: 0.03}}\n"
                                "  initial: {x1: 0.001}\n  noise: 1.0e-6\n  seed: 18446744073709551615\n"
                                "model:\n");
  const Configuration c = parse_configuration(text, "a.yaml");
  const SimulationConfig& s = *c.simulation;
  EXPECT_EQ(s.plant.drive.gap, 0.03);
  EXPECT_EQ(s.plant.drive.mass_ratio, 2.0);
  EXPECT_EQ(s.plant.structure.contact, ContactLaw::kRigid);
  EXPECT_EQ(s.plant.structure.restitution, 0.8);
  EXPECT_EQ(c.model.structure.contact, ContactLaw::kCompliant);
  EXPECT_EQ(parameter(c, "gap").value, 0.02);
  EXPECT_EQ(s.initial.x1, 0.001);
  EXPECT_EQ(s.noise, 1e-6);
  EXPECT_EQ(s.seed, ~std::uint64_t{0});
  EXPECT_EQ(s.samples(), 1000u);
}

TEST(Configuration, TheSimulatedPlantTakesTheValueOfAnEstimatedParameter) {
  const Configuration c = parse_configuration(
      with(kSimulated, "gap: 0.02", "gap: {value: 0.02, estimate: true, bounds: [0, 0.3]}"), "a.yaml");
  EXPECT_EQ(c.simulation->plant.drive.gap, 0.02);
}

TEST(Configuration, EveryExcitationCanBeAsked) {
  const std::string sine = "{sine: {amplitude: 0.5, frequency: 2}}";
  for (const char* excitation :
       {"{multisine: {amplitude: 1, low: 1, high: 20, lines: 5, period: 1}}",
        "{swept_sine: {amplitude: 1, start_frequency: 1, stop_frequency: 9, logarithmic: true}}",
        "{triangle: {amplitude: 1, frequency: 2, offset: 0.1}}",
        "{trapezoid: {amplitude: 1, frequency: 2, dwell: 0.3, rise: 0.1}}",
        "{steps: {amplitude: 1, hold: 0.05, levels: 3}}", "{sine: {amplitude: 1, frequency: 2, phase: 1}}"}) {
    const Configuration c = parse_configuration(with(kSimulated, sine, excitation), "a.yaml");
    EXPECT_EQ(c.simulation->excitation.amplitude, 1.0) << excitation;
  }
}

TEST(Configuration, TheBoundCanBeANumberOrComeFromTheModel) {
  const auto with_bound = [](const std::string& bound) {
    return parse_configuration(with(kRecorded, "bound: auto", "bound: " + bound), "a.yaml");
  };
  EXPECT_EQ(with_bound("120").detector.bound, 120.0);
  const Configuration c = with_bound("{from_model: {input_limit: 0.5, load_force_bound: 5.0e-5}}");
  // The paper's drive with a mass ratio of 1 has 98 < L < 147 rad/s²; the lower end does not depend on the
  // ratio.
  EXPECT_NEAR(bound_from_model(c).low, 98.0, 0.5);
  EXPECT_NEAR(bound_from_model(parse_configuration(
                                   with(with(kRecorded, "value: 1.2", "value: 1.0"), "bound: auto",
                                        "bound: {from_model: {input_limit: 0.5, load_force_bound: 5.0e-5}}"),
                                   "a.yaml"))
                  .high,
              147.0, 0.5);
}

TEST(Configuration, TheDiagnosisIsToldWhatIsKnown) {
  const Configuration c = parse_configuration(std::string(kSimulated) +
                                                  "diagnosis: {periods_per_turn: [4, 24], periods: [0.0025], "
                                                  "outside_catalogue: 0.2, detectable: true}\n",
                                              "a.yaml");
  EXPECT_EQ(c.diagnosis.periods_per_turn, (std::vector<double>{4.0, 24.0}));
  EXPECT_EQ(c.diagnosis.periods, std::vector<double>{0.0025});
  EXPECT_EQ(c.diagnosis.outside_catalogue, 0.2);
  EXPECT_TRUE(c.diagnosis.detectable);
}

TEST(Configuration, TranslationCountsInMetres) {
  const Configuration c = parse_configuration(
      with(with(kRecorded, "rotation", "translation"), "{bits: 20}", "{quantum: 5.0e-8}"), "a.yaml");
  EXPECT_EQ(c.coordinates, Coordinates::kTranslation);
  EXPECT_EQ(c.encoder.quantum, 5e-8);
}

TEST(Configuration, TheResolvedTextReadsBackAsItself) {
  const std::string odd_names =
      with(with(kRecorded, "train.csv", "\"a \\\"b\\\" # c.csv\""), "input: u", "input: 'no'");
  const std::string overridden =
      with(kSimulated, "model:\n", "  model: {parameters: {mass_ratio: 0}}\nmodel:\n");
  for (const std::string& text : {kRecorded, kSimulated, odd_names, overridden}) {
    const std::string once = resolved_yaml(parse_configuration(text, "a.yaml"));
    EXPECT_EQ(resolved_yaml(parse_configuration(once, "a.yaml")), once);
  }
  const Configuration c =
      parse_configuration(resolved_yaml(parse_configuration(kSimulated, "a.yaml")), "b.yaml");
  EXPECT_EQ(c.name, "sim");
  EXPECT_EQ(c.simulation->seed, 1u);
  EXPECT_EQ(c.simulation->plant.drive.contact_stiffness, 200.0);
}

TEST(Configuration, EveryConfigurationOfTheRepositoryLoads) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GAPSCOPE_CONFIGS)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".yaml" || name.find("campaign") != std::string::npos) continue;
    ++count;
    if (name.find("blind") != std::string::npos) {
      const std::string resolved = resolved_yaml(load_blind_config(entry.path().string()));
      EXPECT_THAT(resolved, ::testing::HasSubstr("name: \"blind\"\n"));
      const testing::TemporaryFile again(resolved, "blind.yaml");
      EXPECT_EQ(resolved_yaml(load_blind_config(again.path())), resolved) << entry.path();
      continue;
    }
    Configuration c;
    ASSERT_NO_THROW(c = load_configuration(entry.path().string())) << entry.path();
    EXPECT_EQ(c.name, name);
    const std::string once = resolved_yaml(c);
    EXPECT_EQ(resolved_yaml(parse_configuration(once, c.file)), once) << entry.path();
  }
  EXPECT_GT(count, 0);
}

TEST(Configuration, AGuessIsKeptAndToldOf) {
  const Configuration c = parse_configuration(
      with(kRecorded, "torque_constant: 0.172", "torque_constant: {value: 1, guess: true}"), "c.yaml");
  EXPECT_EQ(c.model.parameters[drive_parameter_index("torque_constant")].value, 1.0);
  EXPECT_FALSE(c.model.parameters[drive_parameter_index("torque_constant")].estimate);
  EXPECT_TRUE(c.input_facts().constant_guessed);
  EXPECT_NE(resolved_yaml(c).find("torque_constant: {value: 1, guess: true}"), std::string::npos);
  EXPECT_FALSE(parse_configuration(kRecorded, "c.yaml").input_facts().told());
}

TEST(Configuration, KnowsTheUnitOfSIInWhichTheInputIsRead) {
  const auto unit = [](const std::string& declared) {
    return parse_configuration(with(kRecorded, "  window:", "  units: {input: " + declared + "}\n  window:"),
                               "c.yaml")
        .input_facts()
        .unit;
  };
  EXPECT_EQ(unit("mA"), "A");
  EXPECT_EQ(unit("mN m"), "N m");
  EXPECT_EQ(unit("V"), "V");
  EXPECT_EQ(unit("'%'"), "") << "of some full scale";
  EXPECT_EQ(unit("0.5"), "");
}

}  // namespace
}  // namespace gapscope
