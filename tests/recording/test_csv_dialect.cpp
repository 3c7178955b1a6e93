// What stands between columns and within numbers, and what drives make of their input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording/csv_rows.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::refusal;
using testing::rows;
using testing::TemporaryFile;

/// The same rows with other marks: between the columns, and of the decimals.
std::string marked(std::string text, char separator, char decimal) {
  for (char& c : text) c = c == ',' ? separator : c == '.' ? decimal : c;
  return text;
}

TEST(CsvDialect, ReadsSemicolonsAndTabsWithADecimalCommaOrPoint) {
  const std::string text = "t,u,x1\n" + rows(60);
  const TemporaryFile plain(text);
  const Recording expected = read_recording(plain.path());
  for (const char separator : {';', '\t'})
    for (const char decimal : {'.', ','}) {
      const TemporaryFile other(marked(text, separator, decimal));
      const Recording r = read_recording(other.path());
      EXPECT_EQ(r.x1, expected.x1) << separator << decimal;
      EXPECT_EQ(r.u, expected.u);
      EXPECT_EQ(r.dt, expected.dt);
    }
}

TEST(CsvDialect, TheSeparatorIsTheOneWithWhichTheColumnsAreThere) {
  ReadOptions options;
  options.columns.position = "angle; motor";
  EXPECT_EQ(refusal("t,u,\"angle; motor\"\n" + rows(60), options), "(accepted)");
  options.columns.position = "angle, motor";
  EXPECT_EQ(refusal("t;u;\"angle, motor\"\n" + marked(rows(60), ';', ','), options), "(accepted)");
}

TEST(CsvDialect, OneFileHasOneDecimalMark) {
  const std::string text = "t;u;x1\n" + marked(rows(60), ';', ',');
  EXPECT_THAT(refusal(text + "0,06;0;1.5\n"),
              HasSubstr("r.csv:62: x1 is '1.5', expected one decimal mark, a comma as in the number before"));
  EXPECT_THAT(refusal(text + "0,06;0;1,234,5\n"), HasSubstr("expected one decimal mark"));
  EXPECT_THAT(refusal("t;u;x1\n" + marked(rows(60), ';', '.') + "0.06;0;1,5\n"),
              HasSubstr("a point as in the number before"));
}

TEST(CsvDialect, ADecimalCommaBetweenCommasIsToldItsRemedy) {
  EXPECT_THAT(
      refusal("t,u,x1\n0,001,0,0,5\n"),
      HasSubstr("r.csv:2: 5 fields, expected 3 as in the header (numbers with a decimal comma need ; or a "
                "tab between the columns)"));
}

TEST(CsvDialect, ADutyTimesTheSupplysVoltageIsTheInput) {
  std::string text = "t,u,x1,volts\n";
  for (int i = 0; i < 60; ++i)
    text += std::to_string(0.01 * i) + "," + std::to_string(i) + ",0," + std::to_string(7400 - 10 * i) + "\n";
  const TemporaryFile file(text);
  ReadOptions options;
  options.columns.voltage = "volts";
  options.columns.scales.input = {1.0, 885.0};
  options.columns.scales.voltage = {1.0, 1000.0};
  const Recording r = read_recording(file.path(), options);
  for (int i = 0; i < 60; ++i) EXPECT_DOUBLE_EQ(r.u[i], (i / 885.0) * (7.4 - 0.01 * i));
  EXPECT_THAT(refusal("t,u,x1\n" + rows(60), options), HasSubstr("there is no column 'volts'"));
}

TEST(CsvDialect, ARegisterThatWasReadWithoutItsSignIsSignedAgain) {
  std::string text = "t,u,x1\n";
  for (int i = 0; i < 60; ++i)
    text += std::to_string(0.01 * i) + "," + std::to_string((65536 + i - 30) % 65536) + ",0\n";
  const TemporaryFile file(text);
  ReadOptions options;
  options.columns.scales.input.form.bits = 16;
  const Recording r = read_recording(file.path(), options);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(r.u[i], i - 30);
}

}  // namespace
}  // namespace gapscope
