// The bound of the e_x that figures show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "sliding_mode/drawn_bound.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

using internal::sliding_mode::drawn_bound;

struct Drawn {
  TestRecording recording = paper_experiment();
  MotorTrace trace = recording.trace();
  internal::signals::SignalFacts facts = internal::signals::read_facts(trace);
  GapEstimate estimate = detect_gap({&trace, 1});
  double of(const std::vector<GapEvent>& events) const {
    return drawn_bound({&trace, 1}, {&facts, 1}, events);
  }
};

TEST(DrawnBound, ShowsAnErrorThatRestsBeforeT1AndPeaksAtT2) {
  const Drawn d;
  ASSERT_EQ(d.estimate.verdict, GapVerdict::kBacklash);
  EXPECT_EQ(d.estimate.bound_t1, d.of(d.estimate.events));
  const std::vector<double>& error = d.estimate.traces[0].error;
  int rests = 0, passages = 0;
  for (const GapEvent& e : d.estimate.events) {
    if (!e.accepted) continue;
    ++passages, rests += std::isfinite(e.t_c);
    const auto at = [&](double t) { return error[static_cast<std::size_t>(std::lround(t / d.trace.dt))]; };
    EXPECT_GT(std::abs(at(e.t2)), 50.0 * std::abs(at(e.t1))) << e.t1;
  }
  EXPECT_GE(passages, 15);
  EXPECT_EQ(rests, passages);
}

TEST(DrawnBound, DoesNotLookAtWhatIsRead) {
  const Drawn d;
  std::vector<GapEvent> others = d.estimate.events;
  for (GapEvent& e : others) e.gap *= 2.0, e.x1_t1 = e.x1_t2 = 0.0;
  EXPECT_EQ(d.of(others), d.of(d.estimate.events));
}

TEST(DrawnBound, SlidesOverTheRecordingWhereNoPassageIsAccepted) {
  const Drawn d;
  std::vector<GapEvent> refused = d.estimate.events;
  for (GapEvent& e : refused) e.accepted = false;
  EXPECT_EQ(d.of(refused), d.of({}));
  EXPECT_GT(d.of({}), d.of(d.estimate.events)) << "the impacts are in it";
}

}  // namespace
}  // namespace gapscope
