// What a user's simulator answers, laid beside the recording that it answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "recording/csv_rows.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
constexpr int kRows = 60;

Recording recorded() {
  const testing::TemporaryFile file("t,u,x1\n" + testing::rows(kRows));
  Recording r = read_recording(file.path());
  r.file = "drive.csv";
  return r;
}

Recording answered(const std::string& text) {
  const testing::TemporaryFile file(text);
  return read_simulated(file.path(), {}, recorded());
}

/// Rows of half a step, the input of the recording times a factor; without one where that is NaN.
std::string finer_rows(double factor, int count = 2 * kRows) {
  std::string text = std::isnan(factor) ? "t,x1\n" : "t,u,x1\n";
  for (int i = 0; i < count; ++i) {
    text += std::to_string(0.0005 * i) + ",";
    if (!std::isnan(factor)) text += std::to_string(factor * (i / 2 % 7)) + ",";
    text += std::to_string(0.02 * i) + "\n";
  }
  return text;
}

TEST(SimulatedFile, IsReadAtTheTimesOfTheRecordingWithItsInput) {
  for (const double factor : {1.0, static_cast<double>(NAN)}) {
    const Recording r = answered(finer_rows(factor));
    EXPECT_EQ(r.u, recorded().u);
    ASSERT_EQ(r.size(), static_cast<std::size_t>(kRows));
    EXPECT_DOUBLE_EQ(r.x1[10], 0.4);
  }
}

TEST(SimulatedFile, OfAnotherInputIsRefusedWhereTheInputsPart) {
  EXPECT_THAT(
      testing::refusal([] { answered(finer_rows(1.01)); }),
      HasSubstr(":4: the input is 1.01 at 0.001 s where drive.csv has 1, expected the simulator's answer"));
}

TEST(SimulatedFile, MustHaveARowAtEveryTimeOfTheRecording) {
  EXPECT_THAT(testing::refusal([] { answered(finer_rows(1.0, 100)); }),
              HasSubstr(":101: there is no row at 0.05 s, the next one is at 0.0495 s, expected one at every "
                        "time of drive.csv"));
}

}  // namespace
}  // namespace gapscope
