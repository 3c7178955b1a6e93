#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "implant/smoothed_motion.h"

namespace {

using namespace gapscope;
using internal::implant::MotionPoint;
using internal::implant::SmoothedMotion;

constexpr double kQuantum = 2.0 * kPi / 65536.0;

double position(double t) { return 3.0 * std::sin(2.0 * t) + 0.4 * std::sin(11.0 * t); }
double speed(double t) { return 6.0 * std::cos(2.0 * t) + 4.4 * std::cos(11.0 * t); }
double acceleration(double t) { return -12.0 * std::sin(2.0 * t) - 48.4 * std::sin(11.0 * t); }

/// Read by 16 bit at 1 kHz, each step up to `uneven` longer or shorter.
Recording read_by_16_bit(double uneven) {
  auto g = random_stream(5, "steps");
  Recording r;
  r.dt = 1e-3, r.quantum = kQuantum;
  double t = 0.0;
  for (int i = 0; i < 4000; ++i) {
    if (uneven > 0.0) r.stamps.push_back(t);
    r.x1.push_back(kQuantum * std::round(position(t) / kQuantum));
    r.u.push_back(0.0);
    t += 1e-3 * (1.0 + uneven * uniform(g, -1.0, 1.0));
  }
  return r;
}

TEST(SmoothedMotion, FollowsSpeedAndAccelerationBetweenCounts) {
  for (const double uneven : {0.0, 0.4}) {
    const Recording r = read_by_16_bit(uneven);
    const SmoothedMotion motion(r.motor_trace());
    double worst_speed = 0.0, worst_acceleration = 0.0;
    for (std::size_t i = 20; i + 20 < motion.size(); ++i) {
      const MotionPoint m = motion.between(i, 0.5);
      worst_speed = std::max(worst_speed, std::abs(m.w - speed(m.t)));
      worst_acceleration = std::max(worst_acceleration, std::abs(m.a - acceleration(m.t)));
    }
    EXPECT_LT(worst_speed, 0.02) << uneven;        // a difference of two counts is 0.1 rad/s
    EXPECT_LT(worst_acceleration, 3.0) << uneven;  // of two differences 96 rad/s²
  }
}

TEST(SmoothedMotion, ErrsByWhatItSays) {
  const Recording r = read_by_16_bit(0.0);
  const SmoothedMotion motion(r.motor_trace());
  int within = 0, all = 0;
  for (std::size_t i = 20; i + 20 < motion.size(); ++i, ++all)
    within += std::abs(motion.at(i).w - speed(motion.at(i).t)) < 2.0 * motion.speed_std(i) ? 1 : 0;
  EXPECT_GT(within, all * 9 / 10);
}

TEST(SmoothedMotion, MeetsBothSamplesAndTheirDerivatives) {
  const Recording r = read_by_16_bit(0.4);
  const SmoothedMotion motion(r.motor_trace());
  for (const std::size_t i : {10u, 500u, 3000u}) {
    const MotionPoint end = motion.between(i, 1.0), next = motion.at(i + 1), here = motion.between(i, 0.0);
    EXPECT_NEAR(here.w, motion.at(i).w, 1e-9);
    EXPECT_NEAR(end.x, next.x, 1e-12);
    EXPECT_NEAR(end.w, next.w, 1e-9);
    EXPECT_NEAR(end.a, next.a, 1e-6);
    const MotionPoint before = motion.between(i, 0.499), after = motion.between(i, 0.501);
    EXPECT_NEAR((after.x - before.x) / (after.t - before.t), motion.between(i, 0.5).w, 1e-4);
  }
}

TEST(SmoothedMotion, StandsWhereTheReadingsDo) {
  Recording r = read_by_16_bit(0.0);
  for (std::size_t i = 2000; i < 4000; ++i) r.x1[i] = r.x1[1999];
  const SmoothedMotion motion(r.motor_trace());
  int standing = 0, moving = 0;
  for (std::size_t i = 100; i < 1900; ++i) moving += motion.direction(i, motion.at(i)) != 0 ? 1 : 0;
  for (std::size_t i = 2100; i < 4000; ++i) standing += motion.direction(i, motion.at(i)) == 0 ? 1 : 0;
  EXPECT_GT(moving, 1750);
  EXPECT_GT(standing, 1850);
  EXPECT_EQ(motion.direction(500, motion.at(500)), speed(0.5) > 0.0 ? 1 : -1);
}

}  // namespace
