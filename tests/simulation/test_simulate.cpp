#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"
#include "gapscope/simulation/simulate.h"
#include "simulation/drives.h"

namespace gapscope {
namespace {

SimulationOptions options(double quantum, double noise, std::uint64_t seed = 1) {
  SimulationOptions o;
  o.rate = 2000.0;
  o.seed = seed;
  o.encoder = {quantum, noise};
  return o;
}

const PlantModel<double> kRig = plant_model(test::paper_rig(), {});
const std::vector<double> kInput = test::sine(0.6, 1.0, 2000.0, 2.0);

TEST(Simulate, TheSameSeedGivesTheSameBytesAndAnotherSeedOtherNoise) {
  const Recording a = simulate(kRig, kInput, options(0.0, 1e-5));
  EXPECT_EQ(a.x1, simulate(kRig, kInput, options(0.0, 1e-5)).x1);
  EXPECT_NE(a.x1, simulate(kRig, kInput, options(0.0, 1e-5, 2)).x1);
}

TEST(Simulate, TheEncoderRoundsToItsNearestCount) {
  const double quantum = 1e-4;
  const Recording exact = simulate(kRig, kInput, options(0.0, 0.0));
  const Recording coarse = simulate(kRig, kInput, options(quantum, 0.0));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LE(std::abs(exact.x1[i] - coarse.x1[i]), 0.5 * quantum * (1.0 + 1e-9));
    EXPECT_NEAR(coarse.x1[i] / quantum, std::nearbyint(coarse.x1[i] / quantum), 1e-9);
  }
}

TEST(Simulate, NoiseHasTheGivenRms) {
  const Recording exact = simulate(kRig, kInput, options(0.0, 0.0));
  const Recording noisy = simulate(kRig, kInput, options(0.0, 1e-5));
  std::vector<double> noise;
  for (std::size_t i = 0; i < exact.size(); ++i) noise.push_back(noisy.x1[i] - exact.x1[i]);
  const double standard_error = 1e-5 / std::sqrt(2.0 * static_cast<double>(noise.size()));
  EXPECT_NEAR(rms(noise), 1e-5, 4.0 * standard_error);
}

TEST(Simulate, ACoarserRealEncoderOverridesTheSheet) {
  PlantModel<double> model = kRig;
  add_effect<double>(model, *find_effect("encoder_quantization"), std::array{1e-3});
  const Recording r = simulate(model, kInput, options(1e-5, 0.0));
  for (const double x : r.x1) EXPECT_NEAR(x / 1e-3, std::nearbyint(x / 1e-3), 1e-9);
}

TEST(Simulate, ModesTellGapEngagementAndImpact) {
  const Recording r = simulate(kRig, kInput, options(0.0, 0.0));
  int count[4] = {};
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double delta = r.x1[i] - r.x2[i];
    if (r.mode[i] == Mode::kEngagementPlus) {
      EXPECT_GT(delta, 0.0);
    }
    if (r.mode[i] == Mode::kEngagementMinus) {
      EXPECT_LT(delta, 0.0);
    }
    ++count[static_cast<int>(r.mode[i]) + 1];
  }
  for (const int n : count) EXPECT_GT(n, 1);
}

TEST(Simulate, OneBodyIsInNoGap) {
  PlantModel<double> model = kRig;
  model.structure.has_load = false;
  const Recording r = simulate(model, kInput, options(0.0, 0.0));
  for (const Mode mode : r.mode) ASSERT_STREQ(to_string(mode), "one_body");
}

TEST(Simulate, StopsBetweenTwoSamples) {
  request_stop();
  EXPECT_THROW(simulate(kRig, kInput, options(0.0, 0.0)), Interrupted);
  clear_stop_request();
  EXPECT_NO_THROW(simulate(kRig, kInput, options(0.0, 0.0)));
}

}  // namespace
}  // namespace gapscope
