#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "recording/csv_rows.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::refusal;
using testing::rows;
using testing::TemporaryFile;

TEST(Csv, ReadsColumnsByNameWhateverTheirOrder) {
  std::string text = "x1,note,t,u\n";
  for (int i = 0; i < 60; ++i) text += std::to_string(i) + ",word," + std::to_string(0.5 * i) + ",3\n";
  const TemporaryFile file(text);
  const Recording r = read_recording(file.path());
  EXPECT_EQ(r.file, "r.csv");
  EXPECT_EQ(r.size(), 60u);
  EXPECT_EQ(r.start, 0.0);
  EXPECT_EQ(r.dt, 0.5);
  EXPECT_EQ(r.u[17], 3.0);
  EXPECT_EQ(r.x1[17], 17.0);
  EXPECT_TRUE(r.x2.empty());
  EXPECT_TRUE(r.resampling.empty());
}

TEST(Csv, AnX2ThatIsX1AgainIsNoSecondEncoder) {
  const auto read = [](double zero, double off) {
    std::string text = "t,u,x1,x2\n";
    for (int i = 0; i < 60; ++i)
      text += fmt::format("{},3,{},{}\n", 0.5 * i, 0.01 * i, 0.01 * i + zero + (i % 7 == 3 ? off : 0.0));
    return read_recording(TemporaryFile(text).path());
  };
  EXPECT_TRUE(read(0.25, 0.0).x2.empty());
  EXPECT_EQ(read(0.25, 0.0).assumed.back().code(), "load_position.copy");
  EXPECT_EQ(read(0.25, 1e-6).x2.size(), 60u);
}

TEST(Csv, ToleratesByteOrderMarkCrlfCommentsBlanksAndQuotes) {
  const TemporaryFile plain("t,u,x1\n" + rows(60));
  std::string text = "\xEF\xBB\xBF# rig P\r\n\r\n \"t\" , u ,\"x1\",\r\n" + rows(30, "\r\n");
  std::string rest = rows(60, " , # later\r\n");
  rest = rest.substr(rows(30, " , # later\r\n").size());
  const TemporaryFile odd(text + "  # half\r\n" + rest + "\r\n\r\n");
  const Recording a = read_recording(plain.path()), b = read_recording(odd.path());
  EXPECT_EQ(a.x1, b.x1);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.dt, b.dt);
}

TEST(Csv, ACommentBeginsALineOrFollowsABlankAndNothingElse) {
  EXPECT_EQ(refusal("t,u,x1\n# of a rig\n" + rows(60, " # later\n") + "#\n"), "(accepted)");
  for (const char* number : {"1.#QNAN", "1.#INF", "-1.#IND"})  // Microsoft's words for what is no number
    EXPECT_THAT(refusal("t,u,x1\n" + rows(60) + "0.06,0," + number + "\n"),
                HasSubstr("r.csv:62: x1 is '" + std::string(number) + "', expected a finite number"));
}

TEST(Csv, NumbersThatNoDriveHasAreRefusedWithTheirLine) {
  for (const char* number : {"1e300", "-1.7e308", "1e200"})
    EXPECT_THAT(refusal("t,u,x1\n" + rows(60) + "0.06,0," + number + "\n"),
                HasSubstr("r.csv:62: x1 is '" + std::string(number) + "', expected at most 1e+15 in size"));
  EXPECT_THAT(refusal("t,u,x1\n" + rows(60) + "0.06,0,1" + std::string(400, '0') + "e-50\n"),
              HasSubstr("expected a finite number"));
  std::string fast = "t,u,x1\n";
  for (int i = 0; i < 60; ++i) fast += std::to_string(i) + "e-300,0,0\n";
  EXPECT_THAT(refusal(fast), HasSubstr("from row to row, expected 1e-10 to 1e+09 s"));
}

TEST(Csv, ALastLineWithoutAnEndIsNoted) {
  const TemporaryFile whole("t,u,x1\n" + rows(55)), cut("t,u,x1\n" + rows(55) + "0.055,0,0.5");
  EXPECT_FALSE(read_recording(whole.path()).open_end);
  EXPECT_TRUE(read_recording(cut.path()).open_end);
}

TEST(Csv, ALastLineWithoutNewlineCounts) {
  std::string text = "t,u,x1\n" + rows(55);
  text.pop_back();
  const TemporaryFile file(text);
  EXPECT_EQ(read_recording(file.path()).size(), 55u);
}

TEST(Csv, WhatWasWrittenReadsBackTheSame) {
  // Rates whose interval is no finite binary number, starts off zero, and values of all magnitudes.
  auto draw = random_stream(1, "csv");
  for (const double rate : {1000.0, 2500.0, 416.7, 30000.0, 12.3456789}) {
    Recording r;
    r.start = rate > 1000.0 ? 17.3 : 0.0;
    r.dt = 1.0 / rate;
    for (int i = 0; i < 2000; ++i) {
      r.u.push_back(normal(draw));
      r.x1.push_back(1e-9 * normal(draw));
      r.x2.push_back(1e7 * normal(draw));
      r.mode.push_back(i % 3 == 0 ? Mode::kGap : Mode::kImpact);
    }
    const TemporaryFile folder("");
    const std::string path = (folder.folder() / "out.csv").string();
    write_csv(path, r);
    const Recording back = read_recording(path);
    EXPECT_EQ(back.start, r.start);
    for (std::size_t i = 0; i < r.size(); ++i) ASSERT_EQ(back.time(i), r.time(i)) << rate;
    EXPECT_EQ(back.u, r.u);
    EXPECT_EQ(back.x1, r.x1);
    EXPECT_EQ(back.x2, r.x2);
    EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  }
}

TEST(Csv, AWindowKeepsBothEnds) {
  const TemporaryFile file("t,u,x1\n" + rows(200));
  ReadOptions options;
  options.window = {0.05, 0.12};
  const Recording r = read_recording(file.path(), options);
  EXPECT_EQ(r.size(), 71u);
  EXPECT_EQ(r.start, 0.05);
  EXPECT_EQ(r.x1.back(), 1.2);
}

TEST(Csv, ColumnsCanBeRenamedAndASecondPositionIsOptionalUnlessNamed) {
  ReadOptions options;
  options.columns = {.time = "time",
                     .input = "i_q",
                     .position = "theta",
                     .load_position = "phi",
                     .load_position_required = false,
                     .scales = {}};
  const TemporaryFile file("time,i_q,theta\n" + rows(60));
  EXPECT_TRUE(read_recording(file.path(), options).x2.empty());
  options.columns.load_position_required = true;
  EXPECT_THAT(refusal("time,i_q,theta\n" + rows(60), options),
              HasSubstr("r.csv:1: there is no column 'phi'"));
}

TEST(Csv, JitterBelowAThousandthOfTheStepIsUniform) {
  const auto jittered = [](double share) {
    std::string text = "t,u,x1\n";
    for (int i = 0; i < 100; ++i) text += std::to_string(i + (i == 50 ? share : 0.0)) + ",0,0\n";
    return text;
  };
  EXPECT_EQ(refusal(jittered(0.0009)), "(accepted)");
  EXPECT_THAT(refusal(jittered(0.0011)), HasSubstr("r.csv:52: time is not uniform"));
}

TEST(Csv, UnevenRowsAreTakenWithTheirTimesWhereThatIsAskedFor) {
  std::string text = "t,u,x1\n";
  for (int i = 0; i < 60; ++i) text += std::to_string(i + 0.25 * (i % 2)) + ",0," + std::to_string(i) + "\n";
  const TemporaryFile file(text);
  ReadOptions options;
  options.uneven = UnevenRows::kStamped;
  options.window = {10.0, 1e9};
  const Recording r = read_recording(file.path(), options);
  ASSERT_EQ(r.stamps.size(), 50u);
  EXPECT_EQ(r.time(1), 11.25);
  EXPECT_DOUBLE_EQ(r.dt, 49.25 / 49.0);
  const TemporaryFile again("");
  write_csv(again.path(), r);
  options.window.reset();
  EXPECT_EQ(read_recording(again.path(), options).stamps, r.stamps);
  options.resample_rate = 1.0;
  EXPECT_TRUE(read_recording(file.path(), options).even());
}

TEST(Csv, UniformRowsHaveNoStampsWhateverIsAskedFor) {
  const TemporaryFile file("t,u,x1\n" + rows(60));
  ReadOptions options;
  options.uneven = UnevenRows::kStamped;
  const Recording r = read_recording(file.path(), options), plain = read_recording(file.path());
  EXPECT_TRUE(r.even());
  EXPECT_EQ(r.dt, plain.dt);
}

struct BadCsv {
  const char* name;
  std::string text;
  const char* message;
};

class BadCsvTest : public ::testing::TestWithParam<BadCsv> {};

TEST_P(BadCsvTest, IsRefusedWithPlaceAndExpectation) {
  const std::string message = refusal(GetParam().text);
  EXPECT_THAT(message, HasSubstr(GetParam().message));
  EXPECT_THAT(message, HasSubstr("expected"));
}

const std::string kHead = "t,u,x1\n";
INSTANTIATE_TEST_SUITE_P(
    Csv, BadCsvTest,
    ::testing::Values(
        BadCsv{"empty", "", "r.csv: is empty"}, BadCsv{"comments_only", "# a\n\n", "r.csv: is empty"},
        BadCsv{"no_header", rows(60),
               "r.csv:1: begins with numbers, expected a CSV in UTF-8 that begins with a header "
               "with the columns t, u, x1"},
        BadCsv{"utf_16", std::string("\xFF\xFEt\0,\0u\0\n\0", 10), "r.csv:1: is text in UTF-16"},
        BadCsv{"returns_alone", "t,u,x1\r0,0,0\r", "r.csv:1: ends its lines with carriage returns alone"},
        BadCsv{"no_text", std::string("PK\x03\x04\0\n", 6), "r.csv:1: is no text"},
        BadCsv{
            "missing_column", "# c\nt,u,y\n" + rows(60),
            "r.csv:2: there is no column 'x1' among 't', 'u', 'y', expected a header with "
            "the columns t, u, x1; other names are declared (recording: columns: position, or --position)"},
        BadCsv{"units_in_brackets", "t [s],u [A],x1 [rad]\n" + rows(60),
               "other names, perhaps 't [s]' here, are declared (recording: columns, or --time"},
        BadCsv{"capitals", "t,u,X1\n" + rows(60), "perhaps 'X1' here"},
        BadCsv{"column_twice", "t,u,x1,u\n", "r.csv:1: the column 'u' is there twice"},
        BadCsv{"a_line_of_another_file", "root:*:20228:0:99999:7:::\n",
               "r.csv:1: there is no column 't' in the first line, expected a header with the columns t, u"},
        BadCsv{"settings", "token = abc, password = def\n",
               "r.csv:1: there is no column 't' in the first line, expected"},
        BadCsv{"other_names", "time;torque;angle\n", "among 'time', 'torque', 'angle', expected"},
        BadCsv{"bars", "t|u|x1\n0|1|2\n", "r.csv:1: there is no column 't'"},
        BadCsv{"decimal_comma", kHead + "0,001,0,5,0,2\n", "r.csv:2: 6 fields, expected 3"},
        BadCsv{"short_row", kHead + rows(3) + "0.003,1\n", "r.csv:5: 2 fields, expected 3"},
        BadCsv{"word", kHead + "0,zero,1\n", "r.csv:2: u is 'zero'"},
        BadCsv{"number_and_more", kHead + "0,0,1.5rad\n", "r.csv:2: x1 is '1.5rad'"},
        BadCsv{"empty_field", kHead + "0,,1\n", "r.csv:2: u is empty"},
        BadCsv{"nan", kHead + "0,0,nan\n", "r.csv:2: x1 is 'nan'"},
        BadCsv{"infinite", kHead + "0,inf,1\n", "r.csv:2: u is 'inf'"},
        BadCsv{"nanoseconds", kHead + "1760000000000000000,0,0\n",
               "a time in ns is declared (--time-unit ns)"},
        BadCsv{"overflow", kHead + "0,0,1e999\n", "r.csv:2: x1 is '1e999'"},
        BadCsv{"binary", kHead + std::string("\x01\x02\0,3,4\n", 7), "r.csv:2: t is '?"},
        BadCsv{"time_repeats", kHead + "0,0,0\n0,0,0\n", "r.csv:3: t goes from 0 to 0 s"},
        BadCsv{"time_falls", kHead + rows(5) + "0.002,0,0\n", "r.csv:7: t goes from 0.004 to 0.002 s"},
        BadCsv{"few_rows", kHead + rows(49), "r.csv: 49 samples, expected at least 50"},
        BadCsv{"pause", kHead + rows(60) + "0.2,0,0\n", "r.csv:62: time is not uniform"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Csv, ALineOfSeparatorsAloneIsBlank) {
  EXPECT_THAT(refusal(kHead + ",,\n" + rows(60) + ";\n"), HasSubstr("r.csv:63: 1 fields, expected 3"));
  const TemporaryFile sheet(kHead + rows(60) + ",,\n,,\n");
  EXPECT_EQ(read_recording(sheet.path()).size(), 60u);
}

TEST(Csv, AMissingFileAFolderAndAnEmptyWindowAreRefused) {
  const TemporaryFile file(kHead + rows(60));
  const auto fails_with = [](const std::string& path, const ReadOptions& options, const char* message) {
    try {
      read_recording(path, options);
      FAIL() << "accepted " << path;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  fails_with(file.path() + "x", {}, "there is no such file");
  fails_with(file.folder().string(), {}, "is no regular file");
  ReadOptions options;
  options.window = {3.0, 4.0};
  fails_with(file.path(), options, "0 samples in the window 3 to 4 s (the file has 0 to 0.059 s)");
}

TEST(Csv, AFileLargerThanAnyRecordingIsRefusedUnread) {
  const TemporaryFile file(kHead + rows(60));
  std::filesystem::resize_file(file.path(), 5'000'000'000);  // a hole: no disk is used
  try {
    read_recording(file.path());
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("r.csv: has 5e+09 bytes, expected at most 4e+09"));
  }
}

TEST(Csv, AnUnwritableFolderIsAFailureThatLeavesNothing) {
  Recording r;
  r.dt = 1.0;
  r.u = r.x1 = std::vector<double>(60, 0.0);
  EXPECT_THROW(write_csv("/nonexistent/folder/out.csv", r), std::runtime_error);
}

}  // namespace
}  // namespace gapscope
