#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "torque_view/low_pass.h"

namespace gapscope::internal::torque_view {
namespace {

/// 200 Hz on average; every step between 0.6 and 1.4 of that.
std::vector<double> uneven_stamps(std::size_t count) {
  std::mt19937_64 generator = random_stream(3, "stamps");
  std::vector<double> t = {0.0};
  while (t.size() < count) t.push_back(t.back() + 0.005 * uniform(generator, 0.6, 1.4));
  return t;
}

TEST(LowPass, PassesHalfThePowerAtItsTop) {
  const double sigma = kernel_sigma(7.0), omega = 2.0 * kPi * 7.0;
  EXPECT_NEAR(std::exp(-0.5 * sigma * sigma * omega * omega), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(sigma, 0.1325 / 7.0, 1e-5);
}

TEST(LowPass, APolynomialOfTheSecondDegreeIsExactOnAnyStamps) {
  const std::vector<double> t = uneven_stamps(400), cells = cell_lengths(t);
  std::vector<double> x;
  for (const double at : t) x.push_back(1e4 - 3.0 * at + 2.5 * at * at);
  SmoothingKernel kernel(t, cells, kernel_sigma(5.0), 3.0);
  for (double T = 0.3; T < 1.6; T += 0.0137) {
    const SmoothMotion m = kernel.motion(x, T);
    EXPECT_NEAR(m.w, -3.0 + 5.0 * T, 1e-9);
    EXPECT_NEAR(m.a, 5.0, 1e-7);
  }
}

TEST(LowPass, SpeedAndAccelerationOfASineAreThoseOfTheFilteredSine) {
  const double hz = 6.0, omega = 2.0 * kPi * 4.0, sigma = kernel_sigma(hz);
  const double passed = std::exp(-0.5 * sigma * sigma * omega * omega);
  std::vector<double> t, x;
  for (int i = 0; i < 1000; ++i) t.push_back(0.001 * i), x.push_back(std::sin(omega * t.back()));
  const std::vector<double> cells = cell_lengths(t);
  SmoothingKernel even(t, cells, sigma, 4.0);  // beyond 4 σ lie 1e-3 of a curvature
  for (double T = 0.3; T < 0.7; T += 0.021) {
    const SmoothMotion m = even.motion(x, T);
    EXPECT_NEAR(m.x, passed * std::sin(omega * T), 2e-3);
    EXPECT_NEAR(m.w, passed * omega * std::cos(omega * T), 2e-3 * omega);
    EXPECT_NEAR(m.a, -passed * omega * omega * std::sin(omega * T), 5e-3 * omega * omega);
  }
}

TEST(LowPass, UnevenStampsLeaveAFewPercentOfWhatTheyCarry) {
  const std::vector<double> t = uneven_stamps(800), cells = cell_lengths(t);
  const double omega = 2.0 * kPi * 3.0, sigma = kernel_sigma(6.0);
  const double passed = std::exp(-0.5 * sigma * sigma * omega * omega);
  std::vector<double> x, error;
  for (const double at : t) x.push_back(std::sin(omega * at));
  SmoothingKernel kernel(t, cells, sigma, 3.0);
  for (double T = 0.3; T < 3.5; T += 0.011)
    error.push_back(kernel.motion(x, T).a / (omega * omega) + passed * std::sin(omega * T));
  EXPECT_LT(rms(error), 0.03 * passed);
}

TEST(LowPass, RowsKeepAConstantAndAStraightLine) {
  const std::vector<double> t = uneven_stamps(400), cells = cell_lengths(t), at = {0.4, 0.7, 1.1};
  const RowFilter filter(t, cells, at, 0.03, 3.0);
  std::vector<double> y, out(3);
  for (const double s : t) y.push_back(2.0 + 7.0 * s);
  filter.apply(y.data(), out.data());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(out[i], 2.0 + 7.0 * at[i], 1e-12);
}

TEST(LowPass, AHeldInputIsHalfASampleLate) {
  const std::vector<double> t = {0.0, 1.0, 2.0, 4.0}, u = {1.0, 3.0, 5.0, 9.0};
  const std::vector<double> held = hold_corrected(t, u);
  EXPECT_DOUBLE_EQ(held[1], 2.0);
  EXPECT_DOUBLE_EQ(held[2], (3.0 * 1.0 + 5.0 * 2.0) / 3.0);
  const std::vector<double> cells = cell_lengths(t);
  EXPECT_DOUBLE_EQ(std::accumulate(cells.begin(), cells.end(), 0.0), 4.0);
}

}  // namespace
}  // namespace gapscope::internal::torque_view
