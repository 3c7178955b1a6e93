#include <gtest/gtest.h>

#include <string>

#include "gapscope/recording/recording_file.h"
#include "gapscope/sliding_mode/detector.h"
#include "support/data.h"

namespace gapscope {
namespace {

GapEstimate detect_in(const std::string& file, const ReadOptions& options = {}) {
  const Recording recording = read_recording((testing::data_folder() / file).string(), options);
  const MotorTrace trace = recording.motor_trace();
  return detect_gap({&trace, 1});
}

TEST(RealRecordings, APreloadedScrewHasNoBacklash) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* file : {"emps/emps_train.csv", "emps/emps_pulses.csv"}) {
    const GapEstimate estimate = detect_in(file);
    EXPECT_NE(estimate.verdict, GapVerdict::kBacklash) << file << ": " << estimate.brief_report();
    EXPECT_FALSE(estimate.reason.empty());
  }
}

constexpr std::pair kSmallRamps{0.0, 20.31}, kLargeRamps{20.32, 1e3}, kAllRamps{0.0, 1e3};

GapEstimate reducer(const std::string& name, std::pair<double, double> window) {
  ReadOptions options;
  options.resample_rate = 400.0;
  options.window = window;
  return detect_in("cycloidal/" + name + ".csv", options);
}

TEST(RealRecordings, ThePlayOfALockedReducerIsReadAtZeroTorque) {
  GAPSCOPE_NEEDS_DATA();
  const GapEstimate estimate = reducer("baseline_pos1", kSmallRamps);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_EQ(estimate.method, GapMethod::kLostMotion);
  EXPECT_EQ(estimate.quantity, GapQuantity::kPlayAtZeroTorque);
  EXPECT_NEAR(estimate.gap / 0.0335, 1.0, 0.1) << "measured by the author of the rig";
}

TEST(RealRecordings, APreloadedReducerHasHysteresisButNoPlay) {
  GAPSCOPE_NEEDS_DATA();
  const GapEstimate small = reducer("splitpreload3_pos1", kSmallRamps);
  EXPECT_EQ(small.verdict, GapVerdict::kNone) << small.brief_report();
  EXPECT_LT(small.smallest_visible_gap, 0.006);
  EXPECT_NE(reducer("splitpreload3_pos1", kLargeRamps).verdict, GapVerdict::kBacklash);
}

TEST(RealRecordings, LargeAndSmallRampsDisagreeAndThatIsTold) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* name : {"baseline_pos1", "splitpreload3_pos1"}) {
    const GapEstimate estimate = reducer(name, kAllRamps);
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << name << ": " << estimate.brief_report();
    EXPECT_NE(estimate.reason.text().find("depends on the torque level"), std::string::npos)
        << estimate.reason.text();
  }
}

}  // namespace
}  // namespace gapscope
