#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/few_recordings.h"
#include "diagnosis/numbers.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Sines of three amplitudes, under a light and a heavy load, each so many times.
class Logs {
 public:
  Logs(int repeats, std::size_t rows) {
    for (const double amplitude : {0.2, 0.5, 1.0})
      for (const double gravity : {0.0, 0.6})
        for (int repeat = 0; repeat < repeats; ++repeat) {
          std::vector<double>& x = samples_.emplace_back();
          for (std::size_t i = 0; i < rows; ++i)
            x.push_back(amplitude * std::sin(0.05 * static_cast<double>(i)));
          MotorTrace& t = traces_.emplace_back();
          t.dt = 0.01, t.u = x, t.x1 = x, t.load.gravity = gravity;
          t.file = std::to_string(amplitude) + " " + std::to_string(gravity);
        }
  }
  const std::vector<MotorTrace>& traces() const { return traces_; }

 private:
  std::deque<std::vector<double>> samples_;
  std::vector<MotorTrace> traces_;
};

std::size_t rows_of(const std::vector<MotorTrace>& traces) {
  std::size_t rows = 0;
  for (const MotorTrace& t : traces) rows += t.size();
  return rows;
}

TEST(FewRecordings, AreAllWhereTheseAreFewOrShort) {
  const Logs short_ones(5, 60), long_ones(1, 30000);
  EXPECT_EQ(few_of(short_ones.traces()).size(), 30u);
  EXPECT_EQ(rows_of(few_of(std::span(long_ones.traces()).first(3))), 90000u);
}

TEST(FewRecordings, HoldEveryKindBeforeARepeat) {
  const Logs logs(6, 600);
  const std::vector<MotorTrace> few = few_of(logs.traces());
  EXPECT_EQ(rows_of(few), kFewRecordings.rows);
  std::set<std::string> kinds;
  for (const MotorTrace& t : few) kinds.insert(t.file);
  EXPECT_EQ(kinds.size(), 6u);
}

TEST(FewRecordings, AreCutWhereTheyAreLong) {
  const Logs logs(1, 6000);
  const std::vector<MotorTrace> few = few_of(logs.traces());
  EXPECT_EQ(few.size(), 3u);
  for (const MotorTrace& t : few) EXPECT_EQ(t.size(), kFewRecordings.longest_rows);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
