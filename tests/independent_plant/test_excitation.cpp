#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "independent_plant/excitation.h"

namespace gapscope::independent_plant {
namespace {

TEST(BlindExcitation, EveryWaveformReachesItsAmplitudeAndStaysWithinIt) {
  for (const Waveform waveform : {Waveform::kSine, Waveform::kMultisine, Waveform::kSweptSine,
                                  Waveform::kTriangle, Waveform::kTrapezoid, Waveform::kSteps}) {
    const std::vector<double> u = command({.waveform = waveform, .amplitude = 0.7}, 1000.0, 40.0, 3);
    ASSERT_EQ(u.size(), 40000u);
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    EXPECT_LE(std::max(-*low, *high), 0.7 + 1e-12);
    EXPECT_GE(std::max(-*low, *high),
              0.9 * 0.7);  // the largest of 40 random levels is below that in 1 of 60 cases
  }
}

TEST(BlindExcitation, PeriodicWavesRepeatAndAreOddAboutHalfAPeriod) {
  for (const Waveform waveform : {Waveform::kSine, Waveform::kTriangle, Waveform::kTrapezoid}) {
    const std::vector<double> u = command({.waveform = waveform, .frequency = 2.0}, 1000.0, 1.0, 1);
    for (std::size_t k = 0; k < 500; ++k) ASSERT_NEAR(u[k], u[k + 500], 1e-9);
    for (std::size_t k = 1; k < 250; ++k) ASSERT_NEAR(u[k], -u[k + 250], 1e-9);
  }
}

TEST(BlindExcitation, TheTrapezoidDwellsAndHoldsForItsShares) {
  const std::vector<double> u = command(
      {.waveform = Waveform::kTrapezoid, .amplitude = 1.0, .dwell = 0.4, .hold = 0.2}, 1000.0, 1.0, 1);
  EXPECT_NEAR(static_cast<double>(std::count(u.begin(), u.end(), 0.0)), 400, 5);
  const auto held = std::count_if(u.begin(), u.end(), [](double v) { return std::abs(v) > 1.0 - 1e-12; });
  EXPECT_NEAR(static_cast<double>(held), 200, 5);
}

}  // namespace
}  // namespace gapscope::independent_plant
