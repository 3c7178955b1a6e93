// Logs that are damaged are refused with the place and what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gapscope/base/errors.h"
#include "inspection/log_form.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using test::as_seen;
using test::clock;
using test::input_at;
using test::kLogStep;
using test::kUsualNames;
using test::lines;
using test::plain;
using test::position_at;
using test::values;
using ::testing::HasSubstr;
using testing::TemporaryFile;

struct Malformed {
  const char* name;
  std::string text;
  const char* message;
};

class MalformedTableTest : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedTableTest, IsRefusedWithItsPlaceAndWhatToDo) {
  const TemporaryFile file(GetParam().text);
  std::vector<std::string> codes;
  try {
    as_seen(file.path(), 0.0, {}, codes);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), HasSubstr("expected"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Malformed, MalformedTableTest,
    ::testing::Values(
        Malformed{
            "words_unknown", "date,time,FT_211,FV_211\n" + lines([](int i) {
                               return clock(i, "2024-11-27,10:{:02}:{:02}.{:03}") + values(i);
                             }),
            "r.csv:1: no column is seen to be the position among 1 'date', 2 'time', 3 'FT_211', 4 'FV_211'"},
        Malformed{"no_time_and_no_rate", "u,x1\n" + lines([](int i) { return values(i).substr(1); }),
                  "--rate HZ"},
        Malformed{"rows_that_are_counted",
                  "sample,u,x1\n" + lines([](int i) { return std::to_string(i) + values(i); }),
                  "expected its name or place: --time NAME, or --rate"},
        Malformed{"four_columns_without_names", lines([](int i) { return plain(i) + ",7"; }),
                  "--columns TIME,INPUT,POSITION"},
        Malformed{"a_clock_that_is_none", "time,u,x1\n" + lines([](int i) {
                                            return clock(i, "10:{:02}:{:02}.{:03}") + values(i);
                                          }) + "10:99:00,1,1\n",
                  "time is '10:99:00', expected a finite number"},
        Malformed{"mostly_blank", "t,u,x1\n" + lines([](int i) {
                                    return i < 40 ? plain(i) : fmt::format("{:.4f},,nan", kLogStep * i);
                                  }),
                  "r.csv:42: u is empty, expected a finite number (40 rows have one in each column)"},
        Malformed{"a_word_among_blanks",
                  "t u x1\n" + lines([](int i) { return i == 9 ? "0.09 lost 0.1" : plain(i, " "); }),
                  "r.csv:11: u is 'lost'"},
        Malformed{"a_short_row_among_blanks",
                  "t u x1\n" + lines([](int i) { return i == 9 ? "0.09 0.1" : plain(i, " "); }),
                  "r.csv:11: 2 fields, expected 3"},
        Malformed{"rows_behind_words",
                  kUsualNames + lines([](int i) { return i == 200 ? "paused" : plain(i); }),
                  "r.csv:202: 1 fields, expected 3"},
        Malformed{"a_short_row_behind", kUsualNames + lines([](int i) { return plain(i); }) + "3.0,0.1\n",
                  "r.csv:302: 2 fields, expected 3"},
        Malformed{"two_numbers_at_one_time",
                  kUsualNames + lines([](int i) { return plain(i) + (i == 9 ? "\n" + plain(i) : ""); }),
                  "r.csv:12: t goes from"},
        Malformed{"two_decimal_marks",
                  kUsualNames + lines([](int i) { return i == 9 ? "0.09,\"1,234.5\",0.1" : plain(i); }),
                  "r.csv:11: u is '1,234.5', expected one decimal mark"},
        Malformed{"neither_up_nor_down",
                  kUsualNames + lines([](int i) { return plain(i < 100 ? i : 200 - i); }),
                  "r.csv:103: t goes from"},
        Malformed{"a_list_that_ends", "time;q;tau\n" + lines([](int i) {
                                        return fmt::format("{:.4f};[{:.8f} 0.5];{}", kLogStep * i,
                                                           position_at(i), i == 5 ? "[]" : "[1 2]");
                                      }),
                  "is a list of 0"},
        Malformed{"times_that_differ", "Time,Torque,Time,Position\n" + lines([](int i) {
                                         return fmt::format("{:.4f},{:.8f},{:.4f},{:.8f}", kLogStep * i,
                                                            input_at(i), kLogStep * i + 0.002,
                                                            position_at(i));
                                       }),
                  "the column 'Time' is there twice, expected it once, or its place from 1 on (1 or 3)"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace gapscope
