// One motion under two names, or in two windows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "run/shared_rows.h"
#include "support/reading.h"

namespace gapscope::internal::run {
namespace {

using ::testing::HasSubstr;

/// Rows `from` to `to` of a motion at 1 kHz, read by an encoder whose noise `seed` makes.
Recording rows(const char* file, std::size_t from, std::size_t to, std::uint64_t seed = 1) {
  Recording r;
  r.file = file, r.dt = 1e-3, r.start = 1e-3 * static_cast<double>(from), r.quantum = 1e-4;
  std::mt19937_64 random = random_stream(seed, "noise");
  for (std::size_t i = 0; i < to; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const double x = 0.1 * std::sin(6.0 * t) / r.quantum + 0.2 * normal(random);
    if (i < from) continue;
    r.u.push_back(0.3 * std::cos(6.0 * t));
    r.x1.push_back(r.quantum * std::round(x));
  }
  return r;
}

std::string refused(const std::vector<Recording>& first, const std::vector<Recording>& others) {
  Configuration c;
  c.file = "drive.yaml";
  return testing::refusal([&] { require_own_rows(c, first, others); });
}

TEST(SharedRows, OfACopyOrOfWindowsThatOverlapAreRefused) {
  const char* const said = "drive.yaml: copy.csv has rows of drive.csv (the same time, input and position)";
  const Recording drive = rows("drive.csv", 0, 3000);
  Recording copy = rows("copy.csv", 0, 3000);
  EXPECT_THAT(refused({}, {drive, copy}), HasSubstr(said));
  EXPECT_THAT(refused({drive}, {copy}), HasSubstr(said)) << "held out";
  copy.start = 1.7e9;
  EXPECT_THAT(refused({}, {drive, copy}), HasSubstr(said)) << "with another start of its clock";
  EXPECT_THAT(refused({}, {drive, rows("copy.csv", 2000, 4000)}), HasSubstr(said)) << "a later window";
  EXPECT_THAT(refused({}, {rows("before.csv", 5000, 6000), drive, rows("copy.csv", 1000, 2000)}),
              HasSubstr(said));
}

TEST(SharedRows, AreNotThoseOfTheSameMotionMadeAgain) {
  const Recording drive = rows("drive.csv", 0, 3000);
  EXPECT_EQ(refused({}, {drive, rows("again.csv", 0, 3000, 2)}), "");
  EXPECT_EQ(refused({}, {drive, rows("later.csv", 3000, 6000)}), "") << "windows that meet";
  Recording resting = rows("resting.csv", 0, 3000);
  Recording still = drive;
  resting.x1.assign(3000, 0.0), still.x1.assign(3000, 0.0);
  EXPECT_EQ(refused({}, {still, resting}), "") << "at rest all rows are alike";
}

}  // namespace
}  // namespace gapscope::internal::run
