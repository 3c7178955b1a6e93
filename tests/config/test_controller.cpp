// `controller:` beside `columns: {target: ...}` – the input that was commanded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gapscope/config/configuration.h"
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

TEST(Controller, IsRefusedWhereItCannotServe) {
  EXPECT_THAT(refusal([] { commanded("{target: goal}", ""); }),
              HasSubstr("c.yaml:2: recording.columns has a target, expected controller:"));
  EXPECT_THAT(
      refusal([] { commanded("{input: duty}", "{position: {gain: 1}}"); }),
      HasSubstr("c.yaml:4: controller stands without the target, expected recording: columns: {target"));
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{velocity: {gain: 1}}"); }),
              HasSubstr("c.yaml:4: unknown key 'velocity' in controller, expected position"));
  EXPECT_THAT(refusal([] { commanded("{target: goal}", "{position: {derivative: 1}}"); }), HasSubstr("gain"));
  EXPECT_THAT(refusal([] { commanded("{target: x1}", "{position: {gain: 1}}"); }),
              HasSubstr("uses the column x1 twice"));
  EXPECT_THAT(
      refusal([] {
        parse_configuration(
            "simulation: {rate: 1000, duration: 1, excitation: {sine: {amplitude: 1, frequency: 1}}}\n"
            "model: {parameters: {motor_inertia: 1, torque_constant: 1, mass_ratio: 0, motor_damping: 0}}\n"
            "controller: {position: {gain: 1}}\n",
            "c.yaml");
      }),
      HasSubstr("c.yaml:3: controller stands beside simulation, expected it with recording:"));
}

TEST(Controller, IsNotEstimatedAndSaysWhatInstead) {
  EXPECT_THAT(
      refusal([] { commanded("{target: goal}", "{position: {gain: {value: 1, estimate: true}}}"); }),
      HasSubstr(
          "c.yaml:4: controller.position.gain is to be estimated, expected a number: where the input was not "
          "recorded, a gain cannot be told from torque_constant"));
}

}  // namespace
}  // namespace gapscope
