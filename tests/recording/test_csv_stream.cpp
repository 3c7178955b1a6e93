#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gapscope/base/errors.h"
#include "recording/csv_stream.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

std::string streamed_rows(int count, double dt = 0.0004) {
  std::string text = "# rig\nt,u,x1,x2\n";
  for (int i = 0; i < count; ++i)
    text +=
        std::to_string(dt * i) + "," + std::to_string(0.01 * i) + "," + std::to_string(-1e-3 * i) + ",0\n";
  return text;
}

std::vector<CsvStream::Sample> read(CsvStream& csv, const std::string& text, std::size_t piece) {
  std::vector<CsvStream::Sample> all;
  const auto take = [&] {
    if (csv.has_clock())
      for (const CsvStream::Sample& s : csv.take()) all.push_back(s);
  };
  for (std::size_t at = 0; at < text.size(); at += piece)
    csv.feed(std::string_view(text).substr(at, piece)), take();
  csv.finish();
  take();
  return all;
}

std::string stream_refusal(const std::string& text, std::size_t piece = 7) {
  CsvStream csv("standard input");
  try {
    read(csv, text, piece);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CsvStream, GivesWhatTheFileGivesHoweverItIsCut) {
  const std::string text = streamed_rows(1500);
  const testing::TemporaryFile file(text);
  const Recording whole = read_recording(file.path());
  for (const std::size_t piece : {std::size_t{1}, std::size_t{13}, text.size()}) {
    CsvStream csv("standard input");
    const auto samples = read(csv, text.substr(0, text.size() - 1), piece);  // the last line need not end
    ASSERT_EQ(samples.size(), whole.size());
    EXPECT_EQ(csv.start(), whole.start);
    EXPECT_EQ(csv.dt(), whole.dt);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      ASSERT_EQ(samples[i].u, whole.u[i]);
      ASSERT_EQ(samples[i].x1, whole.x1[i]);
    }
  }
}

/// Rows that come 2 to 4 ms apart.
std::string uneven_rows(int count) {
  std::string text = "t,u,x1\n";
  double t = 0.25;
  for (int i = 0; i < count; ++i) {
    text += fmt::format("{:.17g},{:.17g},{:.17g}\n", t, std::sin(0.7 * i), std::cos(0.05 * i));
    t += 0.003 + 0.001 * std::sin(2.3 * i);
  }
  return text;
}

TEST(CsvStream, BringsUnevenRowsToARateAsAWholeFileIsBrought) {
  const std::string text = uneven_rows(400);
  const testing::TemporaryFile file(text);
  for (const double rate : {60.0, 250.0, 3000.0}) {
    ReadOptions options;
    options.resample_rate = rate;
    const Recording whole = read_recording(file.path(), options);
    CsvStream csv("standard input", {}, rate);
    const auto samples = read(csv, text, 17);
    ASSERT_EQ(samples.size(), whole.size()) << rate;
    EXPECT_EQ(csv.start(), whole.start);
    EXPECT_EQ(csv.dt(), whole.dt);
    for (std::size_t i = 0; i < samples.size(); ++i) {  // but for the rounding of sums
      ASSERT_NEAR(samples[i].t, whole.time(i), 1e-12);
      ASSERT_NEAR(samples[i].u, whole.u[i], 1e-11) << i;
      ASSERT_NEAR(samples[i].x1, whole.x1[i], 1e-11) << i;
    }
  }
  EXPECT_THAT(stream_refusal(uneven_rows(1200)), HasSubstr("or --resample RATE (here about 333"));
}

TEST(CsvStream, RefusesBrokenLinesWithTheirNumber) {
  EXPECT_THAT(stream_refusal(""),
              HasSubstr("standard input: is empty, expected a header with the columns t, u, x1"));
  EXPECT_THAT(stream_refusal("t,u\n0,1\n"), HasSubstr("standard input:1: there is no column 'x1'"));
  EXPECT_THAT(stream_refusal(streamed_rows(49)),
              HasSubstr("standard input: 49 samples, expected at least 50"));
  EXPECT_THAT(stream_refusal(streamed_rows(60) + "0.024,x,0,0\n"),
              HasSubstr("standard input:63: u is 'x', expected a finite number"));
  EXPECT_THAT(stream_refusal(streamed_rows(60) + "0.024,1\n"),
              HasSubstr("standard input:63: 2 fields, expected 4"));
  EXPECT_THAT(stream_refusal(streamed_rows(60) + "0.0236,0,0,0\n"),
              HasSubstr("standard input:63: t goes from 0.0236 to 0.0236 s"));
  EXPECT_THAT(stream_refusal(streamed_rows(1200) + "0.4804,0,0,0\n"),
              HasSubstr("standard input:1203: time is not uniform: a step of 0.8 ms, expected 0.4 ms"));
  EXPECT_THAT(stream_refusal(streamed_rows(1200) + "nan,0,0,0\n"),
              HasSubstr("standard input:1203: t is 'nan'"));
  EXPECT_THAT(stream_refusal(streamed_rows(60) + std::string(100000, '1'), 4096),
              HasSubstr("standard input:63: a line of more than 65536 characters"));
}

TEST(CsvStream, RowsBeforeABrokenOneCanStillBeTaken) {
  CsvStream csv("standard input");
  EXPECT_THROW(csv.feed(streamed_rows(1100) + "broken\n"), ConfigError);
  EXPECT_EQ(csv.take().size(), 1100u);
}

}  // namespace
}  // namespace gapscope
