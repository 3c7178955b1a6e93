// What common drives write, in one command.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"
#include "inspection/rows.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::Workplace;

struct PresetCase {
  const char *name, *header;
  double time, input, position;  ///< recorded units for one of SI
  double voltage;                ///< recorded, constant; 0: none
  bool unsigned_input;
  std::vector<const char*> declared;
};
void PrintTo(const PresetCase& c, std::ostream* out) { *out << c.name; }

class Preset : public ::testing::TestWithParam<PresetCase> {};

TEST_P(Preset, ReadsTheDrivesOwnColumns) {
  const PresetCase& c = GetParam();
  const testing::Rows rows = testing::rig();
  std::string text = std::string(c.header) + "\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    double u = std::round(c.input * rows.u[i]);
    if (c.unsigned_input && u < 0.0) u += 65536.0;
    const double x = c.position > 600.0 ? std::round(c.position * rows.x1[i]) : c.position * rows.x1[i];
    text += fmt::format("{:.9g},{},{:.9g}{}\n", c.time * rows.t[i], u, x,
                        c.voltage > 0.0 ? fmt::format(",{}", c.voltage) : "");
  }
  Workplace place;
  place.file("log.csv", text);
  const auto init = place.run(std::string("init log.csv --model gap --preset ") + c.name);
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("preset      "));
  const std::string yaml = testing::text_of(place.folder() / "log.yaml");
  for (const char* declared : c.declared) EXPECT_THAT(yaml, HasSubstr(declared));
  const auto check = place.run(std::string("check log.csv --preset ") + c.name);
  EXPECT_THAT(check.out, HasSubstr("at 1000 Hz, uniform"));
  EXPECT_THAT(check.out, HasSubstr("as a motor in rad may move"));
  place.file("other.csv", "a,b,c\n1,2,3\n");
  EXPECT_THAT(place.run(std::string("check other.csv --preset ") + c.name).err,
              HasSubstr("which is not there: what is taken in its place is read as it stands"));
}

const std::vector<PresetCase> kPresetCases = {
    {"dynamixel",
     "timestamp,present_pwm,present_position,present_input_voltage",
     1.0,
     500.0,
     4096.0 / 6.283185307,
     74.0,
     true,
     {"voltage: \"present_input_voltage\"",
      "units: {input: \"0.00113\", position: \"counts\", voltage: \"0.1\"}", "registers: {input: 16}",
      "encoder: {bits: 12}"}},
    {"dynamixel",
     "timestamp,load,position,input_volts",
     1.0,
     500.0,
     1.0,
     7.4,
     true,
     {"input: \"load\", position: \"position\", voltage: \"input_volts\"",
      "units: {input: \"permille\", position: \"rad\", voltage: \"V\"}", "registers: {input: 16}",
      "encoder: {bits: 12}"}},
    {"feetech",
     "time,present_load,present_position,present_voltage",
     1.0,
     800.0,
     4096.0 / 6.283185307,
     120.0,
     false,
     {"input: \"permille\"", "encoder: {bits: 12}"}},
    {"odrive",
     "t,iq_measured,pos_estimate",
     1.0,
     100.0,
     1.0 / 6.283185307,
     0.0,
     false,
     {"units: {input: \"A\", position: \"rev\"}"}},
    {"moteus", "t,q_current,position", 1.0, 100.0, 1.0 / 6.283185307, 0.0, false, {"position: \"rev\""}},
    {"twincat",
     "Time,ActTorque,ActPos",
     1000.0,
     900.0,
     57.29577951,
     0.0,
     false,
     {"units: {time: \"ms\", input: \"permille\", position: \"deg\"}"}},
};

/// An input of another name may be another quantity.
TEST(PresetOfOtherColumns, SaysWhatItLeavesOutForAColumnOfAnotherName) {
  const testing::Rows rows = testing::rig();
  std::string text = "timestamp,effort,present_position,volts\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i)
    text += fmt::format("{:.9g},{},{:.9g},7.4\n", rows.t[i], std::round(500.0 * rows.u[i]),
                        std::round(4096.0 / 6.283185307 * rows.x1[i]));
  Workplace place;
  place.file("log.csv", text);
  const auto named = place.run("init log.csv --model gap --preset dynamixel --input effort");
  EXPECT_EQ(named.status, 0) << named.err;
  EXPECT_THAT(named.out, ::testing::Not(HasSubstr("u = duty x volts")));
  EXPECT_THAT(named.err, HasSubstr("not of 'effort': u is read as it stands"));
  EXPECT_THAT(named.err,
              HasSubstr("--input-unit 0.00113 --input-register 16 --voltage COLUMN --voltage-unit 0.1"));
  EXPECT_THAT(testing::text_of(place.folder() / "log.yaml"), ::testing::Not(HasSubstr("0.00113")));
  const auto told = place.run(
      "check log.csv --preset dynamixel --input effort --input-unit 0.00113 --input-register 16 --voltage volts "
      "--voltage-unit V");
  EXPECT_EQ(told.err, "");
  EXPECT_THAT(place.run("check log.csv --preset dynamixel --input effort --position volts").err,
              HasSubstr("'volts' is read in counts"));
}

/// Present Load and Present PWM are two units.
TEST(PresetOfOtherColumns, SaysInWhichUnitALoadIsRead) {
  const testing::Rows rows = testing::rig();
  std::string text = "timestamp,load,position,input_volts\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i)
    text += fmt::format("{:.9g},{},{:.9g},7.4\n", rows.t[i], std::round(500.0 * rows.u[i]), rows.x1[i]);
  Workplace place;
  place.file("log.csv", text);
  EXPECT_THAT(place.run("check log.csv --preset dynamixel").err,
              HasSubstr("'load' is read as Present Load, 0.1 % a unit"));
  EXPECT_EQ(place.run("check log.csv --preset dynamixel --input-unit 0.00113").err, "");
  place.file("none.csv", "timestamp,duty,position\n0,1,2\n");
  EXPECT_THAT(place.run("check none.csv --preset dynamixel").err,
              HasSubstr("which is not there: what is taken in its place is read as it stands"));
}

/// A preset's names are words: what they are written with, and the number of a servo behind them, is nothing.
TEST(PresetOfOtherColumns, KnowsItsNamesByTheirWords) {
  const testing::Rows rows = testing::rig();
  std::string text = "timestamp,pos (1),load (1),pos (2),load (2)\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    const double load = std::round(800.0 * rows.u[i]);
    text += fmt::format("{:.9g},{},{},2047,8\n", rows.t[i], std::round(4096.0 / 6.283185307 * rows.x1[i]),
                        load < 0.0 ? 1024.0 - load : load);
  }
  Workplace place;
  place.file("log.csv", text);
  const auto init = place.run("init log.csv --model gap --preset feetech");
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.err, HasSubstr("u is the duty alone"));
  const std::string yaml = testing::text_of(place.folder() / "log.yaml");
  for (const char* declared : {"input: \"load (1)\"", "units: {input: \"permille\", position: \"counts\"}",
                               "registers: {input: {sign_bit: 10}}", "encoder: {bits: 12}"})
    EXPECT_THAT(yaml, HasSubstr(declared));
}

INSTANTIATE_TEST_SUITE_P(Of, Preset, ::testing::ValuesIn(kPresetCases), [](const auto& tested) {
  return fmt::format("{}_{}", tested.param.name, tested.index);
});

}  // namespace
}  // namespace gapscope
