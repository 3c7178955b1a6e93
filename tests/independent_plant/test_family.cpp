#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drives/family.h"

namespace gapscope::independent_plant {
namespace {

class EveryFamily : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Family, EveryFamily, testing::ValuesIn(family_names()),
                         [](const auto& i) { return i.param; });

/// The first seconds of a case.
ChainCase beginning(ChainCase c, double seconds) {
  c.options.duration = std::min(seconds, c.options.duration);
  return c;
}

TEST_P(EveryFamily, IsAFunctionOfItsSeed) {
  const ChainCase c = draw_family(GetParam(), 7), again = draw_family(GetParam(), 7);
  const ChainRun one = simulate_chain(beginning(c, 2.0)), other = simulate_chain(beginning(again, 2.0));
  EXPECT_EQ(one.recording.u, other.recording.u);
  EXPECT_EQ(one.recording.x1, other.recording.x1);
  EXPECT_EQ(one.recording.x2, other.recording.x2);
  EXPECT_NE(draw_family(GetParam(), 8).nominal_gap, c.nominal_gap);
}

TEST_P(EveryFamily, ConvergesWithTheStep) {
  ChainCase c = beginning(draw_family(GetParam(), 3), 1.0);
  c.sensor = {};  // one count more or less would go back into a loop
  c.options.tolerance = 1e-8;
  const ChainRun coarse = simulate_chain(c);
  c.options.tolerance = 1e-10;
  const ChainRun fine = simulate_chain(c);
  c.options.tolerance = 1e-12;
  const ChainRun finest = simulate_chain(c);
  double coarse_error = 0.0, fine_error = 0.0;
  for (std::size_t k = 0; k < finest.x1.size(); ++k) {
    coarse_error = std::max(coarse_error, std::abs(coarse.x1[k] - finest.x1[k]));
    fine_error = std::max(fine_error, std::abs(fine.x1[k] - finest.x1[k]));
  }
  EXPECT_LT(coarse_error, 1e-5);
  EXPECT_LT(fine_error, std::max(0.3 * coarse_error, 1e-8));
}

TEST_P(EveryFamily, HasATwinWithoutItsGapsThatDiffersInNothingElse) {
  const ChainCase c = draw_family(GetParam(), 5), twin = draw_family(GetParam(), 5, true);
  EXPECT_GT(total_gap(c.drive).low, 0.0);
  EXPECT_EQ(total_gap(twin.drive).high, 0.0);
  EXPECT_EQ(twin.nominal_gap, c.nominal_gap);
  EXPECT_EQ(twin.drive.load().inertia, c.drive.load().inertia);
  EXPECT_EQ(twin.drive.load().friction.coulomb_nm, c.drive.load().friction.coulomb_nm);
  EXPECT_EQ(twin.drive.joints[0].stiffness, c.drive.joints[0].stiffness);
  EXPECT_EQ(twin.torque_nm, c.torque_nm);
  EXPECT_TRUE(simulate_chain(beginning(twin, 0.5)).events.empty());
}

TEST_P(EveryFamily, ASheetIsWithinAFifthOfTheDrive) {
  const ChainCase c = draw_family(GetParam(), 11);
  const ChainSheet sheet = chain_sheet(c);
  EXPECT_EQ(sheet.motor_inertia, c.drive.motor().inertia);
  EXPECT_NEAR(sheet.gap / c.nominal_gap, 1.0, 0.2);
  EXPECT_NEAR(sheet.motor_damping / c.drive.motor().damping, 1.0, 0.2);
  EXPECT_GT(sheet.contact_stiffness, 0.0);
  EXPECT_GT(sheet.contact_damping, 0.0);
}

TEST(Family, LowTravelIsThatOfTheMotorOverThreePeriods) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    ChainCase c = draw_family("low_travel", seed);
    c.sensor = {};
    const double period = 1.0 / std::get<BlindExcitation>(c.task).frequency;
    const ChainRun run = simulate_chain(beginning(c, 4.0 * period));
    const auto settled = run.x1.begin() + static_cast<std::ptrdiff_t>(run.x1.size() / 4);
    const auto [low, high] = std::minmax_element(settled, run.x1.end());
    EXPECT_NEAR((*high - *low) / c.nominal_gap, c.wanted_travel, 0.1 * c.wanted_travel) << seed;
  }
}

TEST(Family, GravityHoldsItsGapShut) {
  const ChainCase c = draw_family("gravity_shut", 2);
  for (const JointEvent& e : simulate_chain(c).events)
    EXPECT_TRUE(e.closed || e.time <= 0.25 * c.options.duration) << e.time;
}

TEST(Family, GapsOfTwoJointsAndOfATurnAreTold) {
  const ChainCase two = draw_family("two_gaps", 1);
  EXPECT_EQ(two.drive.bodies.size(), 3u);
  EXPECT_DOUBLE_EQ(total_gap(two.drive).low, two.drive.joints[0].gap + two.drive.joints[1].gap);
  EXPECT_DOUBLE_EQ(first_gap(two.drive).high, two.drive.joints[0].gap);
  const ChainCase varying = draw_family("varying_gap", 1);
  EXPECT_LT(total_gap(varying.drive).low, varying.nominal_gap);
  EXPECT_GT(total_gap(varying.drive).high, varying.nominal_gap);
}

TEST(Family, ThereIsNoOtherThanTheNamedOnes) { EXPECT_THROW(draw_family("as_told", 1), std::logic_error); }

}  // namespace
}  // namespace gapscope::independent_plant
