#include <gtest/gtest.h>

#include <cmath>

#include "recording/array_fixture.h"
#include "recording/lost_rows.h"

namespace gapscope {
namespace {

/// 200 rows a millisecond apart, off by up to a fifth, without those that were lost.
Recording rows_without(const std::vector<int>& lost, double slope) {
  Recording r;
  for (int i = 0; i < 200; ++i) {
    if (std::find(lost.begin(), lost.end(), i) != lost.end()) continue;
    r.stamps.push_back(1e-3 * (i + 0.2 * std::sin(3.0 * i)));
    r.u.push_back(slope * i);
    r.x1.push_back(0.0);
  }
  return r;
}

TEST(LostRows, AreCountedAndLeaveTheImpulseOfALine) {
  Recording r = rows_without({50, 100, 101}, 1.0);
  EXPECT_EQ(lost_rows(r), 3u);
  EXPECT_EQ(bridge_lost_rows(r), 3u);
  EXPECT_DOUBLE_EQ(r.u[49], 49.5);   // of 49 and 50
  EXPECT_DOUBLE_EQ(r.u[98], 100.0);  // of 99, 100 and 101
  EXPECT_DOUBLE_EQ(r.u[48], 48.0);
}

TEST(LostRows, AreNoneOnAGridOrWithJitterAlone) {
  Recording r = rows_without({}, 1.0);
  EXPECT_EQ(bridge_lost_rows(r), 0u);
  r.stamps.clear();
  EXPECT_EQ(lost_rows(r), 0u);
}

TEST(LostRows, AreNoneWhereAStampAloneIsLate) {
  Recording r = rows_without({}, 1.0);
  r.stamps[100] += 0.7e-3;
  EXPECT_EQ(lost_rows(r), 0u);
  for (std::size_t i = 101; i < r.stamps.size(); ++i) r.stamps[i] += 1e-3;
  EXPECT_EQ(lost_rows(r), 1u);
}

TEST(LostRows, AreNoneWhereAClockOfWholeMillisecondsIsTooCoarse) {
  Recording r;
  for (int i = 0; i < 500; ++i) r.stamps.push_back(1e-3 * std::round(i / 0.7));
  EXPECT_EQ(lost_rows(r), 0u);
}

TEST(LostRows, AreNoneWhereALoopSlowsDownForAWhile) {
  Recording r;
  for (int i = 0; i < 200; ++i) {
    r.stamps.push_back(i < 80 ? 5.3e-3 * i : 0.424 + 3.4e-3 * (i - 80));
    r.u.push_back(0.0), r.x1.push_back(0.0);
  }
  EXPECT_EQ(lost_rows(r), 0u);
}

TEST(LostRows, AreBridgedOnRequestAlone) {
  std::string text = "t,u,x1\n";
  for (int i = 0; i < 100; ++i)
    if (i != 50) text += std::to_string(0.001 * i) + "," + std::to_string(i) + ",0\n";
  const testing::TemporaryFile file(text);
  ReadOptions options;
  options.uneven = UnevenRows::kStamped;
  EXPECT_EQ(read_recording(file.path(), options).u[49], 49.0);
  options.lost_rows = LostRows::kBridged;
  EXPECT_EQ(read_recording(file.path(), options).u[49], 49.5);
}

}  // namespace
}  // namespace gapscope
