#include <gtest/gtest.h>

#include <string>

#include "gapscope/recording/csv.h"
#include "gapscope/sliding_mode/detector.h"
#include "support/data.h"

namespace gapscope {
namespace {

GapEstimate detect_in(const std::string& file, const CsvOptions& options = {}) {
  const Recording recording = read_csv((testing::data_folder() / file).string(), options);
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

TEST(RealRecordings, AQuasiStaticReducerWithLockedOutputIsToldAsSuchAndNotGuessed) {
  GAPSCOPE_NEEDS_DATA();
  CsvOptions options;
  options.resample_rate = 400.0;
  for (const auto& window : {std::pair{0.0, 20.31}, std::pair{20.32, 1e3}})
    for (const char* file : {"cycloidal/baseline_pos1.csv", "cycloidal/splitpreload3_pos1.csv"}) {
      options.window = window;
      const GapEstimate estimate = detect_in(file, options);
      EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << file << ": " << estimate.brief_report();
      EXPECT_NE(estimate.reason.find("quasi-static"), std::string::npos) << estimate.reason;
    }
}

}  // namespace
}  // namespace gapscope
