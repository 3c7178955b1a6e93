#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/place.h"
#include "diagnosis/where.h"

namespace gapscope {
namespace {

using internal::diagnosis::HeldOut;
using internal::diagnosis::place_of;
using internal::diagnosis::Playback;

/// A torque that is damping, under ten times as much noise, which the error budget does not count.
TEST(Where, ThePlaceIsOfTheBandThatTheSizeIsOf) {
  std::vector<double> u, x1;
  Playback p;
  constexpr double kStep = 1e-3;
  std::uint32_t draw = 1;
  for (int i = 0; i < 8000; ++i) {
    const double angle = 2.0 * kPi * 0.5 * kStep * i, w = std::sin(angle);
    draw = 1664525u * draw + 1013904223u;
    u.push_back(0.0), x1.push_back(-std::cos(angle)), p.w1.push_back(w);
    p.torque.push_back(w + ((draw >> 31) == 0 ? 10.0 : -10.0));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  EXPECT_TRUE(place_of({p}, held, 1.0, {}, nullptr).follows.empty());
  EXPECT_EQ(place_of({p}, held, 1.0, {}, nullptr, 5.0).follows, std::vector{ResidualPattern::kSpeed});
}

/// A gap is crossed twice a second; for 20 ms behind each impact the contact's law leaves a torque.
TEST(Where, WhatTheContactLeavesIsPlacedBehindItsImpacts) {
  std::vector<double> u, x1;
  Playback p;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 8000; ++i) {
    const int since = i % 500;  // of the impact
    u.push_back(0.0), x1.push_back(0.01 * ((i * 37) % 101)), p.w1.push_back(0.1 * ((i * 53) % 89));
    p.torque.push_back(since < 20 ? (since % 2 == 0 ? 1.0 : -1.0) : (i % 2 == 0 ? 0.01 : -0.01));
    p.mode.push_back(since > 400 ? Mode::kGap : Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  const MapShare behind = place_of({p}, held, 1.0, {}, nullptr).behind_impacts;
  EXPECT_NEAR(behind.share, 1.0, 0.01);
  EXPECT_NEAR(behind.expected, 0.07, 0.01);
}

/// One way for a second, then at rest, where the encoder's last count flickers and an observer makes motion
/// of it.
TEST(Where, ADriveThatStandsMovesInNoDirection) {
  constexpr double kStep = 1e-3, kQuantum = 1e-3;
  std::vector<double> u, x1;
  Playback p;
  for (int i = 0; i < 4000; ++i) {
    const bool moves = i < 1000, odd = i % 2 == 1;
    const double x = moves ? 0.4 * kStep * i : 0.4 + (odd ? kQuantum : 0.0);
    u.push_back(0.0), x1.push_back(kQuantum * std::round(x / kQuantum));
    p.w1.push_back(moves ? 0.4 : odd ? 0.1 : -0.1), p.torque.push_back(1.0 + (odd ? 0.1 : 0.0));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1, trace.quantum = kQuantum;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {kQuantum / std::sqrt(12.0)},
  held.periods = {0.0};
  const MismatchPlace place = place_of({p}, held, 1.0, {}, nullptr);
  EXPECT_EQ(place.direction[0].expected, 0.0);
  EXPECT_EQ(place.direction[1].expected, 1.0);
  const auto lacking = internal::diagnosis::lacking_way(place.direction);
  ASSERT_TRUE(lacking.has_value());
  EXPECT_EQ(lacking->way, "backward");
  EXPECT_TRUE(lacking->none);
}

TEST(Where, ACycleOfTheEncodersCountsIsNoFinding) {
  constexpr double kStep = 1e-3, kCounts = 4096.0;
  std::vector<double> u(8000, 0.0), x1;
  Playback p;
  for (int i = 0; i < 8000; ++i) {
    x1.push_back(0.15 * (1.0 - std::cos(2.0 * kPi * 0.125 * kStep * i)));
    p.w1.push_back(0.0), p.torque.push_back(std::sin(kCounts * x1.back()));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  EXPECT_NEAR(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn, kCounts, 0.01 * kCounts);
  for (const double counts_in_cycle : {1.0, 0.3, 1.9}) {
    held.traces[0].quantum = 2.0 * kPi / kCounts / counts_in_cycle;
    EXPECT_TRUE(std::isnan(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn)) << counts_in_cycle;
  }
  held.traces[0].quantum = 2.0 * kPi / kCounts / 2.1;
  EXPECT_NEAR(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn, kCounts, 0.01 * kCounts);
}

TEST(Where, LeavesTheTimeToWhatNoEffectExplains) {
  const std::vector<internal::diagnosis::PatternStrength> patterns = {{ResidualPattern::kSpeed, 0.2},
                                                                      {ResidualPattern::kTime, 0.9}};
  EXPECT_EQ(internal::diagnosis::followed_patterns(patterns, nullptr), std::vector{ResidualPattern::kTime});
  const ModelEffect cogging{find_effect("cogging_torque"), {}};
  EXPECT_EQ(internal::diagnosis::followed_patterns(patterns, &cogging), std::vector{ResidualPattern::kAngle});
}

}  // namespace
}  // namespace gapscope
