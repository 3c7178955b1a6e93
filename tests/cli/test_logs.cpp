// Logs as they come: check and init say what they take for granted, and what init writes takes nothing for
// granted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/executable.h"
#include "inspection/rows.h"
#include "support/data.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

/// The rig's rows, each as a text of its number.
std::string log_of(const std::function<std::string(const testing::Rows&, std::size_t)>& line) {
  static const testing::Rows rows = testing::rig();
  std::string text;
  for (std::size_t i = 0; i < rows.t.size(); ++i) text += line(rows, i) + "\n";
  return text;
}

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

struct LogFile {
  const char* name;
  std::string text, options;
  const char* told;     ///< by check
  const char* written;  ///< by init
};

void PrintTo(const LogFile& l, std::ostream* out) { *out << l.name; }

class LogFileTest : public ::testing::TestWithParam<LogFile> {};

TEST_P(LogFileTest, IsReadWithWhatIsToldAndWhatInitWritesRunsAlone) {
  Workplace place;
  place.file("log.csv", GetParam().text);
  const auto check = place.run("check log.csv " + GetParam().options);
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  EXPECT_THAT(check.out, HasSubstr(GetParam().told));
  EXPECT_THAT(check.out, HasSubstr("8000 samples"));
  const auto init = place.run("init log.csv --model gap " + GetParam().options);
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(testing::text_of(place.folder() / "log.yaml"), HasSubstr(GetParam().written));
  const auto detect = place.run("detect log.yaml -o report");
  EXPECT_EQ(detect.status, 0) << detect.err;
  EXPECT_THAT(detect.out, HasSubstr("model-free"));
  EXPECT_THAT(detect.out, HasSubstr("backlash")) << detect.out;
}

const std::vector<LogFile> kLogFiles = {
    {"units_below", "Time,Position,Torque\ns,deg,Nm\n" + log_of([](const testing::Rows& r, std::size_t i) {
                      return fmt::format("{:.4f},{:.8f},{:.6f}", r.t[i], degrees(r.x1[i]), r.u[i]);
                    }),
     "", "table       units in line 2", "units: {time: \"s\", input: \"Nm\", position: \"deg\"}"},
    {"no_header", log_of([](const testing::Rows& r, std::size_t i) {
       return fmt::format("{:.4f} {:.6f} {:.10f}", r.t[i], r.u[i], r.x1[i]);
     }),
     "", "blanks between the columns", "columns: {time: \"1\", input: \"2\", position: \"3\"}"},
    {"no_time", "current_A,theta\n" + log_of([](const testing::Rows& r, std::size_t i) {
                  return fmt::format("{:.6f},{:.10f}", r.u[i], r.x1[i]);
                }),
     "--rate 1000", "position 'theta', input 'current_A', by their names", "rate: 1000"},
    {"places", "date;a;b;c\n" + log_of([](const testing::Rows& r, std::size_t i) {
                 return fmt::format("2026-01-05;{:.4f};{:.6f};{:.10f}", r.t[i], r.u[i], r.x1[i]);
               }),
     "--columns 2,3,4", "uniform", "columns: {time: \"2\", input: \"3\", position: \"4\"}"},
    {"stamps", "timestamp,pos_deg,torque_Nm\n" + log_of([](const testing::Rows& r, std::size_t i) {
                 return fmt::format("2024-11-27 10:00:{:02}.{:03},{:.8f},{:.6f}", i / 1000, i % 1000,
                                    degrees(r.x1[i]), r.u[i]);
               }),
     "", "times of a clock", "columns: {time: \"timestamp\", input: \"torque_Nm\", position: \"pos_deg\"}"},
    {"milliseconds", "time,torque,angle\n" + log_of([](const testing::Rows& r, std::size_t i) {
                       return fmt::format("{},{:.6f},{:.10f}", i, r.u[i], r.x1[i]);
                     }),
     "", "'time' in ms, as it goes on", "units: {time: \"ms\"}"},
    {"register", "t,current_raw,angle\n" + log_of([](const testing::Rows& r, std::size_t i) {
                   return fmt::format("{:.4f},{},{:.10f}", r.t[i],
                                      (65536 + static_cast<int>(std::lround(1000.0 * r.u[i]))) % 65536,
                                      r.x1[i]);
                 }),
     "", "'current_raw' is a signed register of 16 bits", "registers: {input: 16}"},
    {"wrapped", "t,u,x1\n" + log_of([](const testing::Rows& r, std::size_t i) {
                  const double x = r.x1[i] + 3.1, turn = 2.0 * std::numbers::pi;
                  return fmt::format("{:.4f},{:.6f},{:.10f}", r.t[i], r.u[i],
                                     x - turn * std::round(x / turn));
                }),
     "", "times, after a turn of 6.283 rad: counted on", "unwrap: true"},
};

INSTANTIATE_TEST_SUITE_P(Logs, LogFileTest, ::testing::ValuesIn(kLogFiles),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Logs, WhatWasAssumedIsData) {
  Workplace place;
  place.file("log.csv", kLogFiles[4].text);
  const auto json = nlohmann::json::parse(place.run("check log.csv --json").out);
  std::vector<std::string> codes;
  for (const auto& assumed : json["assumed"]) codes.push_back(assumed["code"]);
  EXPECT_THAT(codes, ::testing::ElementsAre("columns.by_name", "table.clock"));
  place.file("plain.csv", testing::rig().csv());
  EXPECT_TRUE(nlohmann::json::parse(place.run("check plain.csv --json").out)["assumed"].empty());
}

/// Files of users, with the one option that some of them need.
TEST(Logs, OfUsersGoInWithAtMostOneOption) {
  GAPSCOPE_NEEDS_DATA();
  const auto folder = std::filesystem::absolute(testing::data_folder()).parent_path() / "field";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no files of users in " << folder;
  Workplace place;
  for (const auto& [file, option] : {std::pair{"logs/unitrow.csv", ""},
                                     {"logs/blank.csv", ""},
                                     {"logs/iso.csv", ""},
                                     {"logs/plc.csv", "--columns 2,4,3"},
                                     {"robots/wizard_preamble/wizard.csv", "--bits 12"},
                                     {"robots/iso_signed_load/servo_log.csv", "--bits 12"},
                                     {"robots/array_cells/state.csv", ""},
                                     {"robots/plotjuggler/plotjuggler.csv", ""},
                                     {"robots/frc_tests/s9_all.csv", ""},
                                     {"robots/wpilog/arm.wpilog", ""},
                                     {"robots/cogging_speed_loop/hall.csv", ""},
                                     {"robots/position_actuator/s3_a.csv", ""},
                                     {"robots/stribeck_zero_help/s6_a.csv", ""},
                                     {"motion/speed/r.csv", ""},
                                     {"motion/stepper/r.csv", "--input steps_mm"}}) {
    const auto check = place.run("check " + (folder / file).string() + " " + option);
    EXPECT_NE(check.status, 2) << file << check.err;
    EXPECT_EQ(check.err, "") << file;
  }
  for (const char* servo : {"s6_a_abs.csv", "s6_b_abs.csv"})
    EXPECT_THAT(place.run("check " + (folder / "robots/abs_current" / servo).string()).out,
                HasSubstr("spoils      input"));
}

/// A recording in place of a configuration is read as init reads it.
TEST(Logs, DetectTakesARecordingAsInitDoes) {
  Workplace place;
  place.file("log.csv", kLogFiles.front().text);
  const auto alone = place.run("detect log.csv -o alone");
  EXPECT_EQ(alone.status, 0) << alone.err;
  EXPECT_THAT(alone.out, AllOf(HasSubstr("table       units in line 2"), HasSubstr("gapscope init log.csv")));
  EXPECT_EQ(place.run("init log.csv").status, 0);
  EXPECT_EQ(place.run("detect log.yaml -o written").status, 0);
  const auto read = [&](const char* folder) {
    return nlohmann::json::parse(testing::text_of(place.folder() / folder / "result.json"))["model_free"];
  };
  EXPECT_EQ(read("alone"), read("written"));
  place.file("log.parquet", "PAR1");
  EXPECT_THAT(place.run("detect log.parquet").err, HasSubstr("read_parquet(FILE).to_csv"));
}

TEST(Logs, AUnitOfSomethingElseIsRefusedWithWhatToDo) {
  Workplace place;
  place.file("log.csv", "t,u,speed_rpm,Angle [xyz]\n0,0,0,0\n");
  const auto speed = place.run("check log.csv --position speed_rpm");
  EXPECT_EQ(speed.status, 2);
  EXPECT_THAT(speed.err, HasSubstr("'speed_rpm' is in 'rpm', which is a speed, expected --speed speed_rpm"));
  EXPECT_THAT(place.run("check log.csv --position 'Angle [xyz]'").err,
              AllOf(HasSubstr("'xyz', which is no known unit here, expected --position-unit with rad"),
                    Not(HasSubstr("speed"))));
  EXPECT_THAT(place.run("check log.csv --columns 1,2").err,
              HasSubstr("expected 3 names or places between commas"));
  EXPECT_THAT(place.run("check log.csv --input-register sign99").err,
              HasSubstr("--input-register is 'sign99', expected"));
}

TEST(Logs, WhatTheYamlSaysOfRowsIsHeldToItsRange) {
  Workplace place;
  place.file("r.csv", testing::rig().csv());
  const auto refused = [&](const std::string& keys) {
    place.file("c.yaml", "name: a\nrecording:\n  file: r.csv\n  " + keys + "\n");
    return place.run("detect c.yaml").err;
  };
  EXPECT_THAT(refused("rate: -1"),
              HasSubstr("c.yaml:4: recording.rate is -1 Hz, expected 0.001 to 10000000 Hz"));
  EXPECT_THAT(refused("input_rows: 1000"), HasSubstr("recording.input_rows is '1000', expected"));
  EXPECT_THAT(refused("unwrap: maybe"), HasSubstr("expected auto or true or false"));
  EXPECT_THAT(refused("columns: {position: x1, speed: u}"),
              HasSubstr("stands beside position, expected one of the two"));
  EXPECT_THAT(refused("units: {speed: rpm}"),
              HasSubstr("has a speed, expected columns: {speed: NAME} beside it"));
  EXPECT_THAT(refused("registers: {input: {sign_bit: 10, offset: 3}}"),
              HasSubstr("expected bits of two's complement"));
}

}  // namespace
}  // namespace gapscope
