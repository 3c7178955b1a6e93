#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drives/reference_motion.h"
#include "gapscope/base/statistics.h"

namespace gapscope::independent_plant {
namespace {

constexpr double kDuration = 20.0, kStep = 1e-4;
constexpr Course kBounded[] = {Course::kSCurve, Course::kTriangle, Course::kTrapezoid, Course::kSines,
                               Course::kPickAndPlace};

std::vector<Target> played(const ReferenceMotion& motion, std::uint64_t seed = 1) {
  const Reference reference(motion, kDuration, seed);
  std::vector<Target> targets;
  for (double t = 0.0; t < kDuration; t += kStep) targets.push_back(reference.at(t));
  return targets;
}

TEST(ReferenceMotion, ItsSpeedIsWhatItsPositionDoes) {
  for (const Course course :
       {Course::kConstantSpeed, Course::kSCurve, Course::kTrapezoid, Course::kSines, Course::kPickAndPlace}) {
    const std::vector<Target> at = played({.course = course});
    for (std::size_t k = 1; k < at.size(); ++k)  // the mean of both ends errs by the change of acceleration
      ASSERT_NEAR((at[k].x - at[k - 1].x) / kStep, 0.5 * (at[k].w + at[k - 1].w), 0.02)
          << static_cast<int>(course) << " at " << kStep * static_cast<double>(k);
  }
}

TEST(ReferenceMotion, ReachesItsTravelAndItsSpeedAndExceedsNeither) {
  for (const Course course : kBounded) {
    double low = kInfinity, high = -kInfinity, fastest = 0.0;
    for (const Target& at : played({.course = course, .travel = 3.0, .speed = 7.0})) {
      low = std::min(low, at.x), high = std::max(high, at.x), fastest = std::max(fastest, std::abs(at.w));
    }
    EXPECT_LE(high - low, 3.0 * 1.001);
    EXPECT_GE(high - low, 0.8 * 3.0) << static_cast<int>(course);  // sines and places come near it
    EXPECT_LE(fastest, 7.0 * 1.001);
    EXPECT_GE(fastest, 0.8 * 7.0) << static_cast<int>(course);
  }
}

TEST(ReferenceMotion, DwellsBetweenItsMoves) {
  const std::vector<Target> at =
      played({.course = Course::kTrapezoid, .travel = 2.0, .speed = 4.0, .dwell_s = 1.0});
  const auto still = std::count_if(at.begin(), at.end(), [](const Target& p) { return p.w == 0.0; });
  const double move = 2.0 / (0.75 * 4.0);
  EXPECT_NEAR(static_cast<double>(still) / static_cast<double>(at.size()), 1.0 / (1.0 + move), 0.05);
}

TEST(ReferenceMotion, OnlyPhasesAndPlacesComeFromTheSeed) {
  for (const Course course : kBounded) {
    const double one = Reference({.course = course}, kDuration, 1).at(7.7).x;
    EXPECT_EQ(one, Reference({.course = course}, kDuration, 1).at(7.7).x);
    const bool drawn = course == Course::kSines || course == Course::kPickAndPlace;
    EXPECT_EQ(one != Reference({.course = course}, kDuration, 2).at(7.7).x, drawn);
  }
}

}  // namespace
}  // namespace gapscope::independent_plant
