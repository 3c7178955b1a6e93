#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gapscope/recording/recording_file.h"
#include "gapscope/sliding_mode/detector.h"
#include "support/data.h"

namespace gapscope {
namespace {

GapEstimate detect_in(const std::string& file, const ReadOptions& options = {}, bool locked = false) {
  const Recording recording = read_recording((testing::data_folder() / file).string(), options);
  const MotorTrace trace = recording.motor_trace();
  return detect_gap({&trace, 1}, {.locked = locked});
}

TEST(RealRecordings, APreloadedScrewHasNoBacklash) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* file : {"emps/emps_train.csv", "emps/emps_pulses.csv"}) {
    const GapEstimate estimate = detect_in(file);
    EXPECT_NE(estimate.verdict, GapVerdict::kBacklash) << file << ": " << estimate.brief_report();
    EXPECT_FALSE(estimate.reason.empty());
    const bool denied = estimate.verdict == GapVerdict::kNone;
    EXPECT_LT(denied ? estimate.smallest_visible_gap : 0.0, 0.0246) << "a tenth of the travel [m]";
  }
}

constexpr std::pair kSmallRamps{0.0, 20.31}, kLargeRamps{20.32, 1e3}, kAllRamps{0.0, 1e3};

GapEstimate reducer(const std::string& name, std::pair<double, double> window) {
  ReadOptions options;
  options.resample_rate = 400.0;
  options.window = window;
  return detect_in("cycloidal/" + name + ".csv", options, true);
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
  EXPECT_NE(small.verdict, GapVerdict::kBacklash) << small.brief_report();
  EXPECT_EQ(small.lost_motion.cause, LostMotionCause::kFriction);
  EXPECT_NEAR(small.lost_motion.value / 0.0029, 1.0, 0.1) << "measured by the author of the rig";
  EXPECT_LT(small.smallest_visible_gap, 0.006);
  EXPECT_NE(reducer("splitpreload3_pos1", kLargeRamps).verdict, GapVerdict::kBacklash);
}

TEST(RealRecordings, LargeAndSmallRampsAreBothTold) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* name : {"baseline_pos1", "splitpreload3_pos1"}) {
    const GapEstimate estimate = reducer(name, kAllRamps);
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << name << ": " << estimate.brief_report();
    EXPECT_EQ(estimate.lost_motion.levels.size(), 2u);
    EXPECT_GT(estimate.lost_motion.range().high, 1.05 * estimate.lost_motion.range().low);
  }
}

/// The author's own figure for each preload, recomputed by whoever keeps the data [rad].
struct Preload {
  const char* file;
  double play;
  bool gap;
};
constexpr Preload kLadder[] = {{"00", 0.0270, true},  {"02", 0.0284, true},  {"04", 0.0295, true},
                               {"05", 0.0051, false}, {"06", 0.0046, false}, {"08", 0.0048, false},
                               {"10", 0.0035, false}, {"12", 0.0051, false}};

TEST(RealRecordings, LostMotionIsToldAtEveryPreloadAndBacklashOnlyWhereThereIsAGap) {
  GAPSCOPE_NEEDS_DATA();
  ReadOptions options;
  options.resample_rate = 400.0;
  int close = 0;
  for (const Preload& p : kLadder) {
    const GapEstimate e = detect_in(std::string("preload_ladder/") + p.file + "_preload.csv", options);
    const LostMotion& m = e.lost_motion;
    ASSERT_TRUE(m.read()) << p.file << ": " << e.brief_report();
    EXPECT_LE(m.ci95.low, p.play) << p.file;
    EXPECT_GE(m.ci95.high, p.play) << p.file;
    close += std::abs(m.value / p.play - 1.0) < 0.05;
    EXPECT_NE(m.cause, p.gap ? LostMotionCause::kFriction : LostMotionCause::kGap)
        << p.file << ": " << m.meaning;
    EXPECT_TRUE(!p.gap || m.gap_limit > 0.9 * p.play) << p.file << ": a gap is not denied " << m.gap_limit;
    EXPECT_TRUE(p.gap || e.verdict != GapVerdict::kBacklash) << p.file;
  }
  EXPECT_GE(close, 7) << "06 moves from ramp to ramp: its ramps allow 3.6 to 7.6 mrad";
}

}  // namespace
}  // namespace gapscope
