#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "recording/resample.h"

namespace gapscope {
namespace {

/// Rows at irregular times (steps of 2 to 4 ms) of a straight line and a random input.
internal::recording::RecordedRows irregular(int count) {
  auto draw = random_stream(3, "resample");
  internal::recording::RecordedRows table;
  double t = 0.25;
  for (int i = 0; i < count; ++i) {
    table.t.push_back(t);
    table.u.push_back(normal(draw));
    table.x1.push_back(2.0 + 3.0 * t);
    table.x2.push_back(-5.0 * t);
    table.line.push_back(i + 2);
    t += uniform(draw, 0.002, 0.004);
  }
  return table;
}

TEST(Resample, PositionsAreLinearBetweenRows) {
  const auto table = irregular(500);
  const Recording r = internal::recording::resample(table, 400.0);
  ASSERT_EQ(r.x1.size(), r.x2.size());
  for (std::size_t i = 0; i < r.size(); ++i) {  // a straight line is kept but for rounding, some 1e-15
    EXPECT_NEAR(r.x1[i], 2.0 + 3.0 * r.time(i), 1e-13);
    EXPECT_NEAR(r.x2[i], -5.0 * r.time(i), 1e-13);
  }
}

TEST(Resample, TheImpulseOfTheInputIsKept) {
  const auto table = irregular(500);
  for (const double rate : {50.0, 400.0, 5000.0}) {
    const Recording r = internal::recording::resample(table, rate);
    double kept = 0.0, held = 0.0;
    for (const double u : r.u) kept += u * r.dt;
    const double end = r.time(r.size());
    for (std::size_t i = 0; i < table.size() && table.t[i] < end; ++i) {
      const double until = i + 1 < table.size() ? std::min(end, table.t[i + 1]) : end;
      held += table.u[i] * (until - table.t[i]);
    }
    EXPECT_NEAR(kept, held, 1e-12) << rate;
  }
}

TEST(Resample, AUniformTableAtItsOwnRateIsUnchanged) {
  internal::recording::RecordedRows table;
  for (int i = 0; i < 100; ++i) {
    table.t.push_back(i / 1000.0);
    table.u.push_back(std::sin(i));
    table.x1.push_back(std::cos(i));
    table.line.push_back(i);
  }
  const Recording r = internal::recording::resample(table, 1000.0);
  ASSERT_EQ(r.size(), table.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    // Rounding of t (1e-17 of 1e-3 s) times the largest step (2 per sample) stays below 1e-12.
    EXPECT_NEAR(r.u[i], table.u[i], 1e-12);
    EXPECT_NEAR(r.x1[i], table.x1[i], 1e-12);
  }
}

TEST(Resample, TheNoteTellsWhatWasDone) {
  const Recording r = internal::recording::resample(irregular(500), 400.0);
  EXPECT_THAT(r.resampling, ::testing::HasSubstr("to 400 Hz"));
  EXPECT_THAT(r.resampling, ::testing::HasSubstr("steps of 2"));
}

TEST(Resample, ARateBeyondReasonIsRefused) {
  EXPECT_THROW(internal::recording::resample(irregular(500), 1e9), ConfigError);
  EXPECT_THROW(internal::recording::resample(irregular(500), 1e5), ConfigError);  // 300 samples a row
}

}  // namespace
}  // namespace gapscope
