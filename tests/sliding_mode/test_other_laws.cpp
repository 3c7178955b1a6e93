// Drives of laws that the detector was not built on: a number that it tells well holds, a bound bounds.
#include <gtest/gtest.h>

#include <string>

#include "drives/family.h"
#include "gapscope/sliding_mode/detector.h"

namespace gapscope {
namespace {

struct Read {
  GapEstimate estimate;
  Interval truth;  ///< [rad]

  bool well() const { return estimate.trust == GapTrust::kGood; }
  bool holds() const { return estimate.ci95.low <= truth.high && truth.low <= estimate.ci95.high; }
};

Read read(const independent_plant::ChainCase& c) {
  const independent_plant::ChainRun run = independent_plant::simulate_chain(c);
  const MotorTrace trace = run.recording.motor_trace();
  return {detect_gap({&trace, 1}), independent_plant::total_gap(c.drive)};
}

Read read(const std::string& family, std::uint64_t seed) {
  return read(independent_plant::draw_family(family, seed));
}

/// A bounce is weaker than the impact before it; what is stronger is the impact of another gap.
TEST(OtherLaws, ASecondImpactThatIsStrongerTellsTheFirstOfSeveralGaps) {
  int seen = 0;
  for (const std::uint64_t seed : {1, 7, 10}) {  // the ones of ten that are read in single passages
    independent_plant::ChainCase c = independent_plant::draw_family("two_gaps", seed);
    c.drive.bodies[1].inertia = c.drive.bodies[0].inertia;
    const Read drive = read(c);
    EXPECT_FALSE(drive.well()) << seed << ": " << drive.estimate.brief_report();
    if (drive.estimate.quantity != GapQuantity::kFirstGap) continue;
    ++seen;
    EXPECT_NEAR(drive.estimate.whole, drive.truth.low, 0.1 * drive.truth.low) << seed;
  }
  EXPECT_GE(seen, 2);
}

/// Gravity holds the gap shut: nothing shows it, and nothing denies it.
TEST(OtherLaws, AContactThatIsHeldClosedIsTheReasonThatNoGapShows) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Read drive = read("gravity_shut", seed);
    EXPECT_EQ(drive.estimate.verdict, GapVerdict::kInconclusive) << drive.estimate.brief_report();
    EXPECT_EQ(drive.estimate.reason.code(), "held_closed") << drive.estimate.brief_report();
  }
}

/// The motor leaves a bounce, rests within the gap and goes on from there.
TEST(OtherLaws, ARestBehindTheTurnIsLookedAtAsOneAtTheTurn) {
  const Read drive = read("hunt_crossley", 20), at_its_load = read("hunt_crossley", 8);
  EXPECT_FALSE(drive.well() && !drive.holds()) << drive.estimate.brief_report();
  EXPECT_TRUE(at_its_load.well() && at_its_load.holds()) << at_its_load.estimate.brief_report();
}

/// At 500 Hz too few samples show how the motor got to its rest; the load had gone on by a quarter of the
/// gap.
TEST(OtherLaws, ARestWhoseArrivalIsTooShortToTellIsNoneAtTheLoad) {
  const Read drive = read("stribeck_load", 24), at_its_load = read("stribeck_load", 13);
  EXPECT_FALSE(drive.well() && !drive.holds()) << drive.estimate.brief_report();
  EXPECT_TRUE(at_its_load.well() && at_its_load.holds()) << at_its_load.estimate.brief_report();
}

/// Its own friction bends where the law has a dry one: that its arrival departs from the law is then no
/// contact.
TEST(OtherLaws, ARestThatFrictionBendsIsNoneAtTheLoad) {
  const Read drive = read("lugre", 6), at_its_load = read("lugre", 16);
  EXPECT_FALSE(drive.well() && !drive.holds()) << drive.estimate.brief_report();
  EXPECT_TRUE(at_its_load.well() && at_its_load.holds()) << at_its_load.estimate.brief_report();
}

/// A mark where x1 stands: as many samples as there are share a rounding, and the search for its onset had no
/// end.
TEST(OtherLaws, AMarkWhereTheMotorStandsEndsInARefusal) {
  const GapEstimate estimate = read("high_friction", 100014).estimate;
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(estimate.reason.code(), "few_passages");
}

TEST(OtherLaws, WhatIsRefusedIsBoundWhereMostPassagesEndInAnImpact) {
  for (const std::uint64_t seed : {2, 6, 9}) {
    const Read drive = read("pd_joint", seed);
    EXPECT_EQ(drive.estimate.verdict, GapVerdict::kInconclusive) << seed;
    EXPECT_GE(drive.estimate.gap_at_most, drive.truth.low) << seed;
  }
}

}  // namespace
}  // namespace gapscope
