// The torque behind the reversals of slow position loops: another integrator, other laws.
#include <gtest/gtest.h>

#include "drives/family.h"
#include "gapscope/sliding_mode/detector.h"
#include "signals/strokes.h"

namespace gapscope {
namespace {

struct Slow {
  GapEstimate estimate;
  double gap = kNaN;  ///< [rad]
};

Slow slow(std::uint64_t seed, bool gap_free = false, const std::string& family = "slow_position") {
  const independent_plant::ChainCase c = independent_plant::draw_family(family, seed, gap_free);
  const independent_plant::ChainRun run = independent_plant::simulate_chain(c);
  const MotorTrace trace = run.recording.motor_trace();
  return {detect_gap({&trace, 1}), independent_plant::total_gap(c.drive).low};
}

TEST(Shelf, TheWayOfALowTorqueBehindAReversalIsTheGap) {
  for (const std::uint64_t seed : {4, 7, 16}) {  // no impact stands out of them
    const Slow drive = slow(seed);
    ASSERT_EQ(drive.estimate.method, GapMethod::kReversal) << seed << ": " << drive.estimate.brief_report();
    EXPECT_EQ(drive.estimate.verdict, GapVerdict::kBacklash);
    EXPECT_NEAR(drive.estimate.gap, drive.gap, 0.03 * drive.gap) << seed;
    EXPECT_LE(drive.estimate.ci95.low, drive.gap) << seed;
    EXPECT_GE(drive.estimate.ci95.high, drive.gap) << seed;
    EXPECT_GE(drive.estimate.events.size(), 4U) << seed;
  }
}

TEST(Shelf, WithoutAGapThereIsNone) {
  for (const std::uint64_t seed : {4, 7, 16})
    EXPECT_NE(slow(seed, true).estimate.verdict, GapVerdict::kBacklash) << seed;
}

TEST(Shelf, ATorqueThatAcceleratesIsNone) {
  for (const std::uint64_t seed : {2, 3, 5})
    EXPECT_NE(slow(seed, false, "as_model").estimate.method, GapMethod::kReversal) << seed;
}

TEST(Turns, AreTheFarthestSamplesOfStrokes) {
  const std::vector<double> x{0.0, 1.0, 2.0, 2.0, 1.0, 0.5, 0.52, 0.0, -1.0, 0.0, 1.0};
  const auto turns = internal::signals::turns(x);
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[0].sample, 2U);
  EXPECT_EQ(turns[0].direction, -1);
  EXPECT_EQ(turns[1].sample, 8U);
  EXPECT_EQ(turns[1].direction, 1);
  EXPECT_EQ(internal::signals::strokes(x), (std::vector<double>{2.0, 3.0, 2.0}));
  EXPECT_TRUE(internal::signals::turns(std::vector<double>(5, 1.0)).empty());
}

}  // namespace
}  // namespace gapscope
