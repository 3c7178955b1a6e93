// The table of a log is found wherever and however it stands in it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/text.h"
#include "inspection/log_form.h"
#include "recording/csv_rows.h"

namespace gapscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::TemporaryFile;

using test::as_seen;
using test::clock;
using test::input_at;
using test::kLogRows;
using test::kLogStep;
using test::kUsualNames;
using test::lines;
using test::plain;
using test::position_at;
using test::values;

struct LogForm {
  const char* name;
  std::string text;
  std::vector<std::string> codes;  ///< that must be told
  double rate = 0.0;
  double near = 1e-6;  ///< of input and position
};

void PrintTo(const LogForm& v, std::ostream* out) { *out << v.name; }

class TableFormTest : public ::testing::TestWithParam<LogForm> {};

TEST_P(TableFormTest, GivesTheSameRecording) {
  const LogForm& v = GetParam();
  const TemporaryFile file(v.text);
  std::vector<std::string> codes;
  const Recording r = as_seen(file.path(), v.rate, {}, codes);
  for (const std::string& code : v.codes) EXPECT_THAT(codes, Contains(code));
  ASSERT_EQ(r.size(), static_cast<std::size_t>(kLogRows));
  for (int i = 0; i < kLogRows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    ASSERT_NEAR(r.time(at) - r.time(0), kLogStep * i, 1e-7) << i;
    ASSERT_NEAR(r.u[at], input_at(i), v.near) << i;
    ASSERT_NEAR(r.x1[at], position_at(i), v.near) << i;
  }
}

const std::vector<LogForm> kLogForms = {
    {"plain", kUsualNames + lines([](int i) { return plain(i); }), {}},
    {"no_header", lines([](int i) { return plain(i); }), {"table.no_names", "columns.by_order"}},
    {"no_header_blanks", lines([](int i) { return plain(i, "   "); }), {"table.no_names", "table.blanks"}},
    {"blanks", "t u x1\n" + lines([](int i) { return plain(i, " "); }), {"table.blanks"}},
    {"blanks_before_rows",
     "  t   u  x1\n" + lines([](int i) { return "   " + plain(i, "   "); }),
     {"table.blanks"}},
    {"blanks_and_decimal_comma",
     "t u x1\n" + lines([](int i) { return plain(i, " ", ','); }),
     {"table.blanks"}},
    {"tabs", "t\tu\tx1\n" + lines([](int i) { return plain(i, "\t"); }), {}},
    {"semicolons_and_decimal_comma", "t;u;x1\n" + lines([](int i) { return plain(i, ";", ','); }), {}},
    {"semicolon_at_the_end", "t;u;x1;\n" + lines([](int i) { return plain(i, ";") + ";"; }), {}},
    {"commas_at_the_end", kUsualNames + lines([](int i) { return plain(i) + ",,"; }), {}},
    {"comma_and_blank", "t, u, x1\n" + lines([](int i) { return plain(i, ", "); }), {}},
    {"lines_before",
     "Recorder 7\nserial: 12\n\nsampled at, 100 Hz\n" + kUsualNames + lines([](int i) { return plain(i); }),
     {"table.lines_before"}},
    {"comments_of_matlab",
     "% rig 3\n%\nt,u,x1\n" + lines([](int i) { return plain(i) + (i == 9 ? "\n% later" : ""); }),
     {}},
    {"names_in_a_comment",
     "# t u x1\n" + lines([](int i) { return plain(i, " "); }),
     {"table.names_in_comment"}},
    {"names_in_a_comment_of_matlab",
     "% made by hand\n% t, u, x1\n" + lines([](int i) { return plain(i); }),
     {"table.names_in_comment"}},
    {"units_below_names",
     "Time,Torque,Position\ns,mNm,deg\n" + lines([](int i) {
       return fmt::format("{:.4f},{:.8f},{:.8f}", kLogStep * i, 1e3 * input_at(i),
                          position_at(i) * 180.0 / std::numbers::pi);
     }),
     {"table.units_below_names", "unit.below_name"}},
    {"units_in_brackets_below_names",
     "Time;Torque;Angle\n[ms];[Nm];[°]\n" + lines([](int i) {
       return fmt::format("{:.1f};{:.8f};{:.8f}", 1e3 * kLogStep * i, input_at(i),
                          position_at(i) * 180.0 / std::numbers::pi);
     }),
     {"table.units_below_names"}},
    {"names_with_units_between_blanks",
     "Time [s]   Torque [Nm]   Position [rad]\n" + lines([](int i) { return plain(i, "  "); }),
     {"table.blanks"}},
    {"wizard",
     "DYNAMIXEL Graph,3,,,,\nItemCount,2,,,MIN,MAX\n-1,1,XM430,Present Position,#ffff00,0\n"
     "Time[ms],Present Current,Present Position,,,\n" +
         lines([](int i) { return fmt::format("{},{:.8f},{:.8f},,,", 10 * i, input_at(i), position_at(i)); }),
     {"table.lines_before", "columns.by_name"}},
    {"iso",
     "timestamp,torque,pos\n" +
         lines([](int i) { return clock(i, "2024-11-27 10:{:02}:{:02}.{:03}") + values(i); }),
     {"table.clock"}},
    {"iso_with_zone",
     "timestamp,torque,pos\n" +
         lines([](int i) { return clock(i, "2024-11-27T10:{:02}:{:02}.{:03}+01:00") + values(i); }),
     {"table.clock"}},
    {"iso_over_midnight",
     "timestamp,torque,pos\n" + lines([](int i) {
       const int ms = (i * 10 + 86398000) % 86400000;
       return fmt::format("2024-11-{}T{:02}:{:02}:{:02}.{:03}Z", i < 200 ? 27 : 28, ms / 3600000,
                          ms / 60000 % 60, ms / 1000 % 60, ms % 1000) +
              values(i);
     }),
     {"table.clock"}},
    {"date_and_time",
     "date,time,torque,pos\n" +
         lines([](int i) { return clock(i, "2024-11-27,10:{:02}:{:02}.{:03}") + values(i); }),
     {"table.clock"}},
    {"german",
     "Datum;Zeit;Drehmoment;Winkel\n" + lines([](int i) {
       return clock(i, "27.11.2024;10:{:02}:{:02},{:03};") +
              fmt::format("{:.8f};{:.8f}", input_at(i), position_at(i));
     }),
     {"table.clock"}},
    {"newest_first",
     kUsualNames + lines([](int i) { return plain(kLogRows - 1 - i); }),
     {"table.newest_first"}},
    {"newest_first_iso",
     "timestamp,torque,pos\n" + lines([](int i) {
       return clock(kLogRows - 1 - i, "2024-11-27 10:{:02}:{:02}.{:03}") + values(kLogRows - 1 - i);
     }),
     {"table.newest_first", "table.clock"}},
    {"milliseconds",
     "time,u,x1\n" + lines([](int i) { return std::to_string(10 * i) + values(i); }),
     {"unit.by_steps"}},
    {"microseconds",
     "timestamp,u,x1\n" + lines([](int i) { return std::to_string(10000 * i) + values(i); }),
     {"unit.by_steps"}},
    {"nanoseconds_since_1970",
     "timestamp,u,x1\n" +
         lines([](int i) { return std::to_string(1764400000000000000 + 10000000LL * i) + values(i); }),
     {"unit.by_steps", "table.clock"}},
    {"ticks_of_100_ns",
     "timestamp,u,x1\n" +
         lines([](int i) { return std::to_string(638000000000000000 + 100000LL * i) + values(i); }),
     {"unit.by_steps", "table.clock"}},
    {"no_time", "u,x1\n" + lines([](int i) { return values(i).substr(1); }), {}, 100.0},
    {"no_time_no_names", lines([](int i) { return values(i).substr(1); }), {"table.no_names"}, 100.0},
    {"lists",
     "type,timestamp,positions,torques\n" + lines([](int i) {
       return fmt::format("STATE,{},\"[{:.8f}, 0.5]\",\"[{:.8f}, 0.1]\"", 10000 * i, position_at(i),
                          input_at(i));
     }),
     {"columns.by_name"}},
    {"lists_of_numpy",
     "time;q;tau\n" + lines([](int i) {
       return fmt::format("{:.4f};[{:.8f} 0.5 1];[{:.8f} 0.1 1]", kLogStep * i, position_at(i), input_at(i));
     }),
     {"columns.by_name"}},
    {"quotes",
     "\"t\",\"u\",\"x1\"\n" + lines([](int i) {
       return fmt::format("\"{:.4f}\",\"{:.8f}\",\"{:.8f}\"", kLogStep * i, input_at(i), position_at(i));
     }),
     {}},
    {"quoted_decimal_commas",
     "\"t\",\"u\",\"x1\"\n" + lines([](int i) {
       std::string row =
           fmt::format("\"{:.4f}\";\"{:.8f}\";\"{:.8f}\"", kLogStep * i, input_at(i), position_at(i));
       for (char& c : row) c = c == '.' ? ',' : c == ';' ? ',' : c;
       return row;
     }),
     {}},
    {"rows_of_one_time",
     "time,position,torque\n" + lines([](int i) {
       return fmt::format("{0:.4f},{1:.8f},\n{0:.4f},,{2:.8f}", kLogStep * i, position_at(i), input_at(i));
     }),
     {"table.joined"}},
    {"latin_1",
     "Zeit [s];Drehmoment [Nm];Winkel [\xB0]\n" + lines([](int i) {
       return fmt::format("{:.4f};{:.8f};{:.9f}", kLogStep * i, input_at(i),
                          position_at(i) * 180.0 / std::numbers::pi);
     }),
     {}},
    {"lines_behind",
     kUsualNames + lines([](int i) { return plain(i); }) + "\nmin,-0.5,-0.3\nend of file\n",
     {"table.lines_behind"}},
    {"a_time_of_another_name",
     ",tick,u,x1\n" + lines([](int i) { return fmt::format("{},{}", i, 10000 * i) + values(i); }),
     {"time.rises", "unit.by_steps"}},
    {"minutes_of_a_sheet",
     "time,u,x1\n" + lines([](int i) {
       const double t = 59.5 + kLogStep * i;
       return fmt::format("{:02}:{:06.3f}", static_cast<int>(t / 60.0), std::fmod(t, 60.0)) + values(i);
     }),
     {"table.clock"}},
    {"minutes",
     "time_min,u,x1\n" + lines([](int i) { return fmt::format("{:.12f}", kLogStep * i / 60.0) + values(i); }),
     {"time.rises"}},
    {"micros",
     "micros,torque,pos\n" + lines([](int i) { return std::to_string(10000 * i) + values(i); }),
     {"unit.by_steps"}},
    {"newton_millimetres",
     "t,Torque [Nmm],Angle [deg]\n" + lines([](int i) {
       return fmt::format("{:.4f},{:.6f},{:.9f}", kLogStep * i, 1e3 * input_at(i),
                          position_at(i) * 180.0 / std::numbers::pi);
     }),
     {}},
    {"lerobot",
     "timestamp,observation.state,action.torque\n" + lines([](int i) {
       return fmt::format("{:.4f},\"[{:.8f}, 0.5]\",\"[{:.8f}, 0.1]\"", kLogStep * i, position_at(i),
                          input_at(i));
     }),
     {"columns.by_name"}},
    {"a_time_for_each_channel",
     "Time,Torque,Time,Position\n" + lines([](int i) {
       return fmt::format("{0:.4f},{1:.8f},{0:.4f},{2:.8f}", kLogStep * i, input_at(i), position_at(i));
     }),
     {}},
    {"nan_here_and_there",
     kUsualNames + lines([](int i) {
       return i == 77 ? fmt::format("{:.4f},{:.8f},nan", kLogStep * i, input_at(i)) : plain(i);
     }),
     {"rows.bridged"},
     0.0,
     1e-3},
    {"a_row_that_jumps",
     kUsualNames + lines([](int i) {
       return i == 77 ? fmt::format("{:.4f},{:.8f},-1.7", kLogStep * i, input_at(i)) : plain(i);
     }),
     {"rows.jumping"},
     0.0,
     1e-3},
    {"two_devices",
     "timestamp,target pos (1),pos (1),load (1),target pos (2),pos (2),load (2)\n" + lines([](int i) {
       return fmt::format("{:.4f},7,{:.8f},{:.8f},3,2,1", kLogStep * i, position_at(i), input_at(i));
     }),
     {"columns.by_name"}},
    {"other_columns",
     "timestamp,voltage,position,velocity\n" + lines([](int i) {
       return fmt::format("{:.4f},{:.8f},{:.8f},0.1", kLogStep * i, input_at(i), position_at(i));
     }),
     {"columns.by_name"}},
};

INSTANTIATE_TEST_SUITE_P(Variants, TableFormTest, ::testing::ValuesIn(kLogForms),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(TableForm, TopicsThatAlternateMeetAtTheRowsOfThePosition) {
  const TemporaryFile file("__time,/joint_states/elbow/position,/motor/current\n" + lines([](int i) {
                             return fmt::format("{:.6f},{:.8f},\n{:.6f},,{:.8f}", 1764400000.0 + kLogStep * i,
                                                position_at(i), 1764400000.0 + kLogStep * (i + 0.5),
                                                input_at(i));
                           }));
  std::vector<std::string> codes;
  const Recording r = as_seen(file.path(), 0.0, {}, codes);
  EXPECT_THAT(codes, Contains("table.topics"));
  ASSERT_EQ(r.size(), static_cast<std::size_t>(kLogRows - 1)) << "before the first input there is none";
  for (int i = 1; i < kLogRows - 1; ++i) {
    EXPECT_NEAR(r.x1[static_cast<std::size_t>(i - 1)], position_at(i), 1e-7);
    EXPECT_NEAR(r.u[static_cast<std::size_t>(i - 1)], 0.5 * (input_at(i - 1) + input_at(i)), 1e-5)
        << "the mean of both";
  }
}

/// The order of the columns says nothing of whose they are, their names do.
TEST(TableForm, ThePositionOfTheSideThatIsAskedForIsTaken) {
  const std::string rows = lines([](int i) {
    return fmt::format("{:.4f},{:.8f},{:.8f},{:.8f}", kLogStep * i, input_at(i), position_at(i),
                       0.9 * position_at(i));
  });
  for (const char* names : {"t,u,load_position,motor_position\n", "t,u,motor_position,load_position\n",
                            "t,u,q_link,q_motor\n", "t,u,output_angle,motor_angle\n"}) {
    const TemporaryFile file(names + rows);
    ColumnGuess load;
    load.side = EncoderSide::kLoad;
    EXPECT_THAT(guess_columns(file.path(), {}, false).position, ::testing::HasSubstr("motor")) << names;
    EXPECT_THAT(guess_columns(file.path(), load, false).position, Not(::testing::HasSubstr("motor")))
        << names;
  }
}

/// On whichever side the encoder is, the motor's torque drives.
TEST(TableForm, TheInputIsTheMotorsWhereverTheEncoderIs) {
  const TemporaryFile file("t,load_torque,motor_torque,load_angle\n" + lines([](int i) {
                             return fmt::format("{:.4f},{:.8f},{:.8f},{:.8f}", kLogStep * i, 0.1, input_at(i),
                                                position_at(i));
                           }));
  ColumnGuess load;
  load.side = EncoderSide::kLoad;
  EXPECT_EQ(guess_columns(file.path(), load, false).input, "motor_torque");
}

/// A servo's log has the voltage of its supply, which is no input, beside the goal that it follows.
TEST(TableForm, ASupplyIsNoInputBesideAGoal) {
  const auto log = [](bool goal, double swing) {
    return std::string(goal ? "t,goal" : "t,rest") + ",x1,volts\n" + lines([&](int i) {
             return fmt::format("{:.4f},{:.8f},{:.8f},{:.3f}", kLogStep * i, 1.1 * position_at(i),
                                position_at(i), 12.0 - swing * (1.0 + std::sin(0.05 * i)));
           });
  };
  const auto guessed = [](const std::string& text) {
    const TemporaryFile file(text);
    return guess_columns(file.path(), {}, false);
  };
  EXPECT_EQ(guessed(log(true, 0.1)).target, "goal");
  EXPECT_EQ(guessed(log(true, 0.1)).input, "");
  EXPECT_EQ(guessed(log(true, 12.0)).input, "volts") << "what drives goes to and fro";
  EXPECT_EQ(guessed(log(false, 0.1)).input, "volts") << "there is nothing else";
}

TEST(TableForm, ASpeedInPlaceOfAPositionIsIntegrated) {
  const TemporaryFile file("time_s,torque_Nm,speed_rpm\n" + lines([](int i) {
                             return fmt::format("{:.4f},{:.8f},{:.8f}", kLogStep * i, input_at(i),
                                                0.3 * 5.0 * std::cos(0.05 * i) * 30.0 / std::numbers::pi);
                           }));
  std::vector<std::string> codes;
  const Recording r = as_seen(file.path(), 0.0, {}, codes);
  EXPECT_THAT(codes, Contains("position.integrated"));
  for (int i = 0; i < kLogRows; ++i) EXPECT_NEAR(r.x1[static_cast<std::size_t>(i)], position_at(i), 2e-4);
}

TEST(TableForm, AWrappedPositionIsCountedOn) {
  const double turn = 2.0 * std::numbers::pi;
  const TemporaryFile file(kUsualNames + lines([&](int i) {
                             const double x = 12.0 * position_at(i);
                             return fmt::format("{:.4f},{:.8f},{:.9f}", kLogStep * i, input_at(i),
                                                x - turn * std::round(x / turn));
                           }));
  const Recording r = read_recording(file.path());
  for (int i = 0; i < kLogRows; ++i)
    EXPECT_NEAR(r.x1[static_cast<std::size_t>(i)], 12.0 * position_at(i), 1e-7);
  ASSERT_EQ(r.assumed.size(), 1u);
  EXPECT_EQ(r.assumed.front().code(), "position.unwrapped");
  ReadOptions options;
  options.unwrap = Unwrap::kNever;
  EXPECT_LT(read_recording(file.path(), options).x1[30], turn / 2.0);
}

TEST(TableForm, AnInputIsMovedByRows) {
  const TemporaryFile file(kUsualNames + lines([](int i) { return plain(i); }));
  ReadOptions options;
  for (const int rows : {-1, 2}) {
    options.input_rows = rows;
    const Recording r = read_recording(file.path(), options);
    ASSERT_EQ(r.size(), static_cast<std::size_t>(kLogRows - std::abs(rows)));
    const int first = std::max(rows, 0);
    EXPECT_NEAR(r.u[10], input_at(first + 10 - rows), 1e-7);
    EXPECT_NEAR(r.x1[10], position_at(first + 10), 1e-7);
  }
}

TEST(TableForm, ColumnsAreNamedByTheirPlaces) {
  const TemporaryFile file("a,b,c,d\n" + lines([](int i) {
                             return fmt::format("{:.4f},7,{:.8f},{:.8f}", kLogStep * i, position_at(i),
                                                input_at(i));
                           }));
  ReadOptions options;
  options.columns.time = "1", options.columns.input = "4", options.columns.position = "3";
  const Recording r = read_recording(file.path(), options);
  EXPECT_NEAR(r.u[40], input_at(40), 1e-7);
  options.columns.position = "5";
  EXPECT_THAT(testing::refusal("a,b,c,d\n0,0,0,0\n", options), HasSubstr("there is no column '5'"));
}

TEST(TableForm, RegistersAreSignedAgain) {
  RegisterForm sign{.sign_bit = 10}, offset{.offset = 2048.0}, two{.bits = 16};
  EXPECT_EQ(sign.number(120.0), 120.0);
  EXPECT_EQ(sign.number(1032.0), -8.0);
  EXPECT_EQ(offset.number(2000.0), -48.0);
  EXPECT_EQ(two.number(65535.0), -1.0);
}

}  // namespace
}  // namespace gapscope
