#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "gapscope/base/errors.h"
#include "gapscope/simulation/excitation.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

constexpr double kSampleRate = 1000.0;
constexpr std::size_t kCount = 10000;

Excitation make(ExcitationKind kind) {
  Excitation e;
  e.kind = kind;
  e.amplitude = 0.5;
  e.frequency = 1.0;
  e.low = 0.5;
  e.high = 10.0;
  e.start_frequency = 0.5;
  e.stop_frequency = 20.0;
  e.dwell = 0.2;
  e.hold = 0.1;
  return e;
}

/// Power of u at one frequency, 1 for a sine of amplitude 1.
double power_at(const std::vector<double>& u, double frequency) {
  double c = 0.0, s = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double angle = 2.0 * kPi * frequency * static_cast<double>(i) / kSampleRate;
    c += u[i] * std::cos(angle);
    s += u[i] * std::sin(angle);
  }
  return 4.0 * (c * c + s * s) / std::pow(static_cast<double>(u.size()), 2);
}

TEST(Excitation, EveryKindKeepsItsAmplitudeAroundItsOffset) {
  for (const auto& spec : excitation_kinds()) {
    if (spec.kind == ExcitationKind::kRecorded) continue;  // has none of its own
    Excitation e = make(spec.kind);
    e.offset = 3.0;
    const auto u = sample(e, kSampleRate, kCount, 1);
    ASSERT_EQ(u.size(), kCount);
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    EXPECT_GE(*low, 2.5 - 1e-12) << spec.name;
    EXPECT_LE(*high, 3.5 + 1e-12) << spec.name;
    // A sweep passes its peak within half a sample of 20 Hz: 1 − cos(2π·20·0.0005) = 2e-3 below it.
    EXPECT_NEAR(std::max(*high - 3.0, 3.0 - *low), 0.5, 2e-3 * 0.5) << spec.name;
  }
}

TEST(Excitation, SameSeedSameInputAndOnlyRandomKindsFollowTheSeed) {
  for (const auto& spec : excitation_kinds()) {
    if (spec.kind == ExcitationKind::kRecorded) continue;
    const Excitation e = make(spec.kind);
    const bool random = spec.kind == ExcitationKind::kMultisine || spec.kind == ExcitationKind::kSteps;
    EXPECT_EQ(sample(e, kSampleRate, kCount, 1), sample(e, kSampleRate, kCount, 1)) << spec.name;
    EXPECT_EQ(sample(e, kSampleRate, kCount, 1) != sample(e, kSampleRate, kCount, 2), random) << spec.name;
  }
}

TEST(Excitation, ASineIsASine) {
  Excitation e = make(ExcitationKind::kSine);
  e.phase = 0.3;
  const auto u = sample(e, kSampleRate, kCount, 1);
  for (std::size_t i = 0; i < kCount; ++i)  // rounding of 2π·10 cycles: 1e-14
    EXPECT_NEAR(u[i], 0.5 * std::sin(2.0 * kPi * static_cast<double>(i) / kSampleRate + 0.3), 1e-13);
}

TEST(Excitation, TrianglesAndTrapezoidsAreOddInTheHalfPeriod) {
  for (const auto kind : {ExcitationKind::kTriangle, ExcitationKind::kTrapezoid}) {
    const auto u = sample(make(kind), kSampleRate, kCount, 1);
    EXPECT_EQ(u[0], 0.0);
    for (std::size_t i = 0; i + 500 < kCount; ++i) EXPECT_NEAR(u[i], -u[i + 500], 1e-12);
  }
  EXPECT_NEAR(sample(make(ExcitationKind::kTriangle), kSampleRate, kCount, 1)[125], 0.25,
              1e-12);  // T/8: half way up
}

TEST(Excitation, ATrapezoidDwellsAtZeroAsLongAsAsked) {
  const auto u = sample(make(ExcitationKind::kTrapezoid), kSampleRate, kCount, 1);
  const auto still = std::count(u.begin(), u.end(), 0.0);
  // 20 % of 10 periods of 1000 samples; each of the 20 dwells may gain or lose a sample to rounding.
  EXPECT_NEAR(static_cast<double>(still), 2000.0, 20.0);
}

TEST(Excitation, AMultisineHasEqualLinesAndNothingBetween) {
  Excitation e = make(ExcitationKind::kMultisine);
  e.lines = 20;  // 0.5, 1.0 … 10 Hz
  const auto u = sample(e, kSampleRate, kCount, 1);
  const double first = power_at(u, 0.5);
  for (int k = 1; k <= 20; ++k) EXPECT_NEAR(power_at(u, 0.5 * k) / first, 1.0, 1e-9);
  EXPECT_LT(power_at(u, 0.7) / first, 1e-20);
}

TEST(Excitation, AMultisineRepeatsWithItsPeriod) {
  Excitation e = make(ExcitationKind::kMultisine);
  e.period = 2.0;
  const auto u = sample(e, kSampleRate, kCount, 1);
  for (std::size_t i = 0; i + 2000 < kCount; ++i) EXPECT_NEAR(u[i], u[i + 2000], 1e-12);
}

TEST(Excitation, ASweepHasTheNumberOfCyclesOfItsMeanFrequency) {
  for (const bool logarithmic : {false, true}) {
    Excitation e = make(ExcitationKind::kSweptSine);
    e.logarithmic = logarithmic;
    const auto u = sample(e, kSampleRate, kCount, 1);
    int rising = 0;
    for (std::size_t i = 1; i < kCount; ++i) rising += u[i - 1] < 0.0 && u[i] >= 0.0;
    const double mean = logarithmic ? (20.0 - 0.5) / std::log(20.0 / 0.5) : (20.0 + 0.5) / 2.0;
    EXPECT_NEAR(rising, mean * 10.0, 1.0);  // the first and the last cycle may be cut
  }
}

TEST(Excitation, StepsHoldTheirLevels) {
  Excitation e = make(ExcitationKind::kSteps);
  e.levels = 5;
  const auto u = sample(e, kSampleRate, kCount, 1);
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(u[i], u[i - i % 100]);
  EXPECT_THAT(std::set<double>(u.begin(), u.end()), ::testing::ElementsAre(-0.5, -0.25, 0.0, 0.25, 0.5));
}

TEST(Excitation, WhatCannotBeIsToldWithWhatWasExpected) {
  Excitation fast = make(ExcitationKind::kSine);
  fast.frequency = 500.0;
  EXPECT_THAT(excitation_problem(fast, kSampleRate, 10.0),
              HasSubstr("expected less than half the sampling rate"));
  Excitation crowded = make(ExcitationKind::kMultisine);
  crowded.lines = 100;
  crowded.period = 1.0;
  EXPECT_THAT(excitation_problem(crowded, kSampleRate, 10.0), HasSubstr("expected at most 10"));
  Excitation reversed = make(ExcitationKind::kMultisine);
  std::swap(reversed.low, reversed.high);
  EXPECT_THAT(excitation_problem(reversed, kSampleRate, 10.0), HasSubstr("expected low <= high"));
  Excitation full = make(ExcitationKind::kTrapezoid);
  full.rise = 0.25;
  EXPECT_THAT(excitation_problem(full, kSampleRate, 10.0), HasSubstr("expected dwell + 4 rise <= 1"));
  EXPECT_THROW(sample(full, kSampleRate, kCount, 1), std::logic_error);
}

TEST(Excitation, TheInputOfARecordingIsPlayedAgainOrRefusedWhereItDoesNotFit) {
  std::string csv = "t,u\n";
  for (int i = 0; i < 100; ++i) csv += std::to_string(0.001 * i) + "," + std::to_string(i % 7) + "\n";
  const testing::TemporaryFile file(csv, "drive.csv");
  Excitation e;
  e.kind = ExcitationKind::kRecorded;
  e.folder = file.folder().string();
  e.file = "drive.csv";
  const auto u = sample(e, 1000.0, 80, 1);
  ASSERT_EQ(u.size(), 80U);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], static_cast<double>(i % 7));
  EXPECT_THROW(sample(e, 500.0, 80, 1), ConfigError);    // another rate
  EXPECT_THROW(sample(e, 1000.0, 200, 1), ConfigError);  // too short
  e.file = "other.csv";
  EXPECT_THROW(sample(e, 1000.0, 80, 1), ConfigError);
  e.file.clear();
  EXPECT_THAT(excitation_problem(e, 1000.0, 0.08), HasSubstr("no file"));
}

}  // namespace
}  // namespace gapscope
