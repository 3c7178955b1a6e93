#include <gtest/gtest.h>

#include <cmath>

#include "inspection/first_row.h"

namespace gapscope {
namespace {

/// Half a second at 1 kHz of u = cos 10 t on a free mass behind a delay, from rest, read in counts.
Recording started(double delay, double first_input = 1.0) {
  Recording r;
  r.dt = 1e-3, r.quantum = 1e-4;
  for (int i = 0; i < 500; ++i) {
    const double t = r.dt * i, acting = std::max(0.0, t - delay);
    r.u.push_back(first_input * std::cos(10.0 * t));
    r.x1.push_back(r.quantum *
                   std::round(first_input * 500.0 * (1.0 - std::cos(10.0 * acting)) / 100.0 / r.quantum));
  }
  return r;
}

std::optional<double> stands(const Recording& r) { return begins_under_input(r.motor_trace()); }

TEST(FirstRow, ThatHasTheInputOnBeforeADriveMovesIsToldWithHowLongThatStands) {
  const auto told = stands(started(4e-3));
  ASSERT_TRUE(told);
  EXPECT_NEAR(*told, 4e-3, 2e-3);
}

TEST(FirstRow, SaysNothingOfADriveThatMovesAtOnceOrIsHeldOrWhoseInputBeginsAtZero) {
  EXPECT_FALSE(stands(started(0.0)));
  EXPECT_FALSE(stands(started(0.2))) << "it is held: by its friction, or against its weight";
  Recording from_zero = started(4e-3);
  from_zero.u.front() = 0.0;
  EXPECT_FALSE(stands(from_zero));
  Recording pushed_back = started(4e-3);
  for (double& x : pushed_back.x1) x = -x;
  EXPECT_FALSE(stands(pushed_back)) << "by something else than its input";
}

}  // namespace
}  // namespace gapscope
