// `controller:` beside `columns: {target: ...}` – the input that was commanded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

const std::string kPosition =
    "{gain: 1.15, derivative: 0.1, integral: 2, rate: 1000, delay: 0.002, saturation: 1, dead_band: 0.003}";

Configuration commanded(const std::string& columns, const std::string& controller) {
  return parse_configuration("recording:\n  file: servo.csv\n  columns: " + columns + "\n" +
                                 (controller.empty() ? "" : "controller: " + controller + "\n"),
                             "c.yaml");
}

TEST(Controller, MakesTheInputOfTheTarget) {
  const Configuration c = commanded("{target: goal, voltage: volts}", "{position: " + kPosition + "}");
  const ReadOptions options = c.recording->reading_for(UnevenRows::kStamped);
  EXPECT_EQ(options.columns.target, "goal");
  EXPECT_FALSE(options.columns.reads_input());
  ASSERT_TRUE(options.controller);
  EXPECT_EQ(options.controller->gain, 1.15);
  EXPECT_EQ(options.controller->derivative, 0.1);
  EXPECT_EQ(options.controller->integral, 2.0);
  EXPECT_EQ(options.controller->rate, 1000.0);
  EXPECT_EQ(options.controller->delay, 0.002);
  EXPECT_EQ(options.controller->saturation, 1.0);
  EXPECT_EQ(options.controller->dead_band, 0.003);
}

TEST(Controller, LeavesAnInputThatIsNamedBesideTheTarget) {
  EXPECT_TRUE(commanded("{input: duty, target: goal}", "{position: {gain: 1}}")
                  .recording->reading.columns.reads_input());
}

TEST(Controller, ComesBackFromTheResolvedText) {
  for (const std::string& own : {std::string("{gain: 2}"), kPosition})
    for (const char* columns : {"{target: goal}", "{input: duty, target: goal}"}) {
      const Configuration c = commanded(columns, "{position: " + own + "}");
      const std::string text = resolved_yaml(c);
      const Configuration again = parse_configuration(text, "c.yaml");
      EXPECT_EQ(resolved_yaml(again), text);
      EXPECT_EQ(again.recording->reading.controller->saturation, c.recording->reading.controller->saturation);
      EXPECT_EQ(again.recording->reading.columns.reads_input(), c.recording->reading.columns.reads_input());
    }
}

TEST(Controller, MayHaveHadAnotherGainInOneRecording) {
  const std::string text =
      "recording:\n  file: [a.csv, {name: b.csv, gain_times: 0.25}]\n  held_out: {name: c.csv, gain_times: 4}\n"
      "  columns: {target: goal}\ncontroller: {position: {gain: 1.15}}\n";
  const Configuration c = parse_configuration(text, "c.yaml");
  const RecordingConfig& r = *c.recording;
  EXPECT_EQ(r.reading_of(r.files[0], UnevenRows::kStamped).gain_times, 1.0);
  EXPECT_EQ(r.reading_of(r.files[1], UnevenRows::kStamped).gain_times, 0.25);
  EXPECT_EQ(r.reading_of(r.held_out[0], UnevenRows::kStamped).gain_times, 4.0);
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
}

TEST(Controller, HasNoOtherGainWhereThereIsNone) {
  const auto refused = [](const std::string& file) {
    return refusal([&] { parse_configuration("recording:\n  file: " + file + "\n", "c.yaml"); });
  };
  EXPECT_THAT(refused("{name: b.csv, gain_times: 2}"),
              HasSubstr("c.yaml:2: a gain stands beside b.csv, expected it beside a recording under"));
  EXPECT_THAT(refused("{name: b.csv, gain_times: 0}"), HasSubstr("gain_times"));
  EXPECT_THAT(refused("{gain_times: 2}"), HasSubstr("file"));
  EXPECT_THAT(refused("{file: b.csv, gain: 2, gain_times: 2}"), HasSubstr("stands beside gain"));
}

TEST(Controller, IsRefusedWhereItCannotServe) {
  EXPECT_THAT(refusal([] { commanded("{target: goal}", ""); }),
              HasSubstr("c.yaml:2: recording.columns has a target, expected controller:"));
  EXPECT_THAT(
      refusal([] { commanded("{input: duty}", "{position: {gain: 1}}"); }),
      HasSubstr("c.yaml:4: controller is given without the target, expected recording: columns: {target"));
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{force: {gain: 1}}"); }),
              HasSubstr("c.yaml:4: unknown key 'force' in controller, expected one of position, velocity"));
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{position: {derivative: 1}}"); }), HasSubstr("gain"));
  EXPECT_THAT(refusal([] { commanded("{target: x1}", "{position: {gain: 1}}"); }),
              HasSubstr("uses the column x1 twice"));
  EXPECT_THAT(
      refusal([] {
        parse_configuration(
            "simulation: {rate: 1000, duration: 1, excitation: {sine: {amplitude: 1, frequency: 1}}}\n"
            "model: {parameters: {motor_inertia: 1, torque_constant: 1, mass_ratio: 0, motor_damping: 0}}\n"
            "controller: {position: {gain: estimate}}\n",
            "c.yaml");
      }),
      HasSubstr("c.yaml:3: controller has a number to be estimated beside a simulation"));
}

TEST(Controller, OfASimulationTakesTheExcitationForItsTarget) {
  const std::string text =
      "simulation: {rate: 1000, duration: 1, excitation: {sine: {amplitude: 1, frequency: 1}}}\n"
      "model: {parameters: {motor_inertia: 1, torque_constant: 1, mass_ratio: 0, motor_damping: 0}}\n"
      "controller: {position: {gain: 2}}\n";
  const Configuration c = parse_configuration(text, "c.yaml");
  ASSERT_TRUE(c.controller);
  EXPECT_EQ(c.controller->at_start().gain, 2.0);
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
}

/// The unit of what the controller gives: the supply multiplies a duty, else it is that of the input.
TEST(Controller, IsWrittenInItsTrueUnit) {
  const auto written = [](const std::string& columns, const std::string& units) {
    return resolved_yaml(parse_configuration(
        "recording: {file: a.csv, columns: " + columns + units + "}\ncontroller: {position: {gain: 2}}\n",
        "c.yaml"));
  };
  EXPECT_THAT(written("{target: goal, voltage: volts}", ""), HasSubstr("gain: 2  # duty per rad"));
  EXPECT_THAT(written("{target: goal}", ", units: {input: mA}"), HasSubstr("gain: 2  # A per rad"));
  EXPECT_THAT(written("{target: goal}", ""), HasSubstr("gain: 2  # unit of u per rad"));
}

TEST(Controller, HasNumbersThatTheFitFinds) {
  const Configuration c = commanded("{target: goal}",
                                    "{position: {gain: estimate, derivative: {value: 0.1, estimate: true, "
                                    "bounds: [0, 1]}, delay: {value: 0.004, estimate: true}, rate: 500}}");
  const ReferenceModel model = c.reference_model();
  ASSERT_TRUE(model.controller);
  const auto& numbers = model.controller->numbers;
  EXPECT_TRUE(numbers[controller_place::kGain].estimate);
  EXPECT_TRUE(std::isnan(numbers[controller_place::kGain].value));
  EXPECT_EQ(numbers[controller_place::kDerivative].high, 1.0);
  EXPECT_EQ(numbers[controller_place::kDelay].value, 0.004);
  EXPECT_FALSE(numbers[controller_place::kIntegral].estimate);
  EXPECT_EQ(model.controller->fixed.rate, 500.0);
  EXPECT_EQ(c.recording->reading.controller->gain, 1.0);  // until the fit knows better
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
  EXPECT_FALSE(commanded("{target: goal}", "{position: {gain: 2}}").reference_model().controller);
}

TEST(Controller, MayBeOfTheSpeedOrACascade) {
  const Configuration speed = commanded("{target: goal}", "{velocity: {gain: 2, integral: 30}}");
  EXPECT_EQ(speed.controller->fixed.kind, ControllerKind::kVelocity);
  EXPECT_EQ(speed.recording->reading.controller->speed_integral, 30.0);
  const Configuration both =
      commanded("{target: goal}", "{position: {gain: 20}, velocity: {gain: estimate, rate: 4000}}");
  EXPECT_EQ(both.controller->fixed.kind, ControllerKind::kCascade);
  EXPECT_EQ(both.recording->reading.controller->gain, 20.0);
  for (const Configuration& c : {speed, both})
    EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
  EXPECT_THAT(refusal([] {
                commanded("{target: goal}", "{position: {gain: 20, integral: 1}, velocity: {gain: 1}}");
              }),
              HasSubstr("unknown key 'integral' in controller.position"));
}

TEST(Controller, SaysWhatAnEstimateNeeds) {
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{position: {gain: 1, derivative: estimate}}"); }),
              HasSubstr("c.yaml:4: controller.position.derivative is to be estimated and has no value"));
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{position: {gain: 1, rate: estimate}}"); }),
              HasSubstr("c.yaml:4: controller.position.rate"));
  EXPECT_THAT(refusal([] { commanded("{input: duty, target: goal}", "{position: {gain: estimate}}"); }),
              HasSubstr("beside a recorded input"));
  EXPECT_THAT(refusal([] {
                parse_configuration(
                    "recording: {file: a.csv, columns: {target: goal}, resample: {rate: 100}}\n"
                    "controller: {position: {gain: estimate}}\n",
                    "c.yaml");
              }),
              HasSubstr("the recording is resampled"));
}

}  // namespace
}  // namespace gapscope
