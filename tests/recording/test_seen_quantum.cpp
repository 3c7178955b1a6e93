#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording_file.h"

namespace gapscope {
namespace {

std::vector<double> motion(int count, double amplitude, double periods) {
  std::vector<double> x1;
  for (int i = 0; i < count; ++i) x1.push_back(amplitude * std::sin(2.0 * kPi * periods * i / count));
  return x1;
}

std::vector<double> counted(std::vector<double> x1, double quantum, double noise = 0.0) {
  auto draw = random_stream(5, "counts");
  for (double& x : x1) x = quantum * std::nearbyint((x + noise * normal(draw)) / quantum);
  return x1;
}

TEST(SeenQuantum, FindsTheCountsOfAnEncoder) {
  for (const int bits : {20, 16, 14, 12}) {
    const double quantum = 2.0 * kPi / std::pow(2.0, bits);
    // Counts are exact multiples but for rounding of the positions, far below 1e-9 of a quantum.
    EXPECT_NEAR(seen_quantum(counted(motion(5000, 0.3, 7.3), quantum)) / quantum, 1.0, 1e-9) << bits;
    EXPECT_NEAR(seen_quantum(counted(motion(5000, 0.3, 7.3), quantum, 1.5 * quantum)) / quantum, 1.0, 1e-9);
  }
}

TEST(SeenQuantum, FindsCountsOfASlowMotionThatMostlyStands) {
  EXPECT_NEAR(seen_quantum(counted(motion(100000, 0.05, 1.0), 1e-3)), 1e-3, 1e-12);
}

TEST(SeenQuantum, PrintedNumbersMayBeRounded) {
  std::vector<double> x1 = counted(motion(5000, 0.3, 7.3), 9.587379924285257e-5);
  for (double& x : x1) x = 1e-9 * std::nearbyint(x * 1e9);
  EXPECT_NEAR(seen_quantum(x1), 9.587379924285257e-5, 1e-9);
}

TEST(SeenQuantum, ASmoothSignalShowsNone) {
  EXPECT_EQ(seen_quantum(motion(5000, 0.3, 7.3)), 0.0);
  EXPECT_EQ(seen_quantum(motion(5000, 0.3, 5.0)), 0.0);  // repeats itself: steps recur, but on no grid
  std::vector<double> ramp;
  for (int i = 0; i < 5000; ++i) ramp.push_back(0.001 * i);
  EXPECT_EQ(seen_quantum(ramp), 0.0);
}

TEST(SeenQuantum, TooFewStepsShowNone) {
  EXPECT_EQ(seen_quantum({}), 0.0);
  EXPECT_EQ(seen_quantum(std::vector<double>(1000, 0.5)), 0.0);
  EXPECT_EQ(seen_quantum(counted(motion(20, 1.0, 1.0), 0.1)), 0.0);
}

std::filesystem::path data_folder() {
  const char* given = std::getenv("GAPSCOPE_DATA");
  return given != nullptr ? given : std::filesystem::path(GAPSCOPE_SOURCE_DIR) / ".." / "shared" / "data";
}

TEST(SeenQuantum, ARealEncoderIsSeenInTheRawSamplesAndKeptWhenResampled) {
  const auto path = data_folder() / "cycloidal" / "baseline_pos1.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the recorded data is not here: " << path;
  ReadOptions options;
  options.window = {0.0, 20.31};
  options.resample_rate = 400.0;
  const Recording r = read_recording(path.string(), options);
  EXPECT_NEAR(r.quantum, 2.0 * kPi / 65536.0, 1e-8);  // 16 bit; positions are printed to 1e-9 … 1e-11 rad
  EXPECT_EQ(r.size(), 8124u);
}

TEST(SeenQuantum, SoFewPositionsAreCountsHoweverTheyFollow) {
  std::vector<double> x1(5000, 0.0);
  x1[3000] = 2.4e-5;  // once, which is too rare to be seen as a step that recurs
  EXPECT_EQ(seen_quantum(x1), 2.4e-5);
  EXPECT_NEAR(seen_quantum(counted(motion(5000, 0.09, 7.3), 0.06)), 0.06, 1e-12);
}

}  // namespace
}  // namespace gapscope
