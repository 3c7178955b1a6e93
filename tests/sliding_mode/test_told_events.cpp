#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gapscope/sliding_mode/detector.h"
#include "signals/signal_facts.h"
#include "sliding_mode/bound_map.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

GapEstimate estimate_of(const TestRecording& recording, const DetectorOptions& options = {}) {
  const MotorTrace trace = recording.trace();
  return detect_gap({&trace, 1}, options);
}

/// The map of bounds is drawn around the passage that is nearest to the estimate.
TEST(ToldEvents, OneWithoutAStartHasItsPlaceInTheMapOfBounds) {
  const TestRecording recording = paper_experiment();
  const MotorTrace trace = recording.trace();
  GapEstimate estimate = estimate_of(recording);
  for (GapEvent& e : estimate.events) e.t1 = e.x1_t1 = kNaN;
  const auto map = internal::sliding_mode::bound_map(trace, internal::signals::read_facts(trace), estimate);
  ASSERT_TRUE(map.has_value());
  EXPECT_GE(map->start, trace.start);
  EXPECT_LT(map->start, trace.time(trace.size() - 1));
}

TEST(ToldEvents, LieOnTheTraceOfTheirRecording) {
  const TestRecording& recording = paper_experiment();
  const GapEstimate estimate = estimate_of(recording);
  ASSERT_GE(std::ranges::count_if(estimate.events, &GapEvent::accepted), 4) << estimate.brief_report();
  for (const GapEvent& e : estimate.events) {
    if (!e.accepted) continue;
    for (const auto& [time, x1] : {std::pair(e.t1, e.x1_t1), std::pair(e.t2, e.x1_t2)}) {
      const double place = time / recording.dt, share = place - std::floor(place);
      const auto i = static_cast<std::size_t>(place);
      const double on_trace = std::lerp(recording.x1[i], recording.x1[i + 1], share);
      EXPECT_NEAR(x1, on_trace, 3.0 * recording.quantum) << "at " << time << " s";
    }
  }
}

TEST(ToldEvents, SayFromWhenTheErrorIsAtRest) {
  const GapEstimate estimate = estimate_of(paper_experiment());
  int told = 0;
  for (const GapEvent& e : estimate.events) {
    if (std::isnan(e.t_c)) continue;
    ++told;
    EXPECT_LT(e.t_c, e.t1 + 0.01);
    EXPECT_GT(e.t_c, e.t1 - 0.5) << "half a period";
  }
  EXPECT_GT(told, 10);
}

TEST(ToldEvents, AGapThatShowsIsNeverBelowTheSmallestThatWould) {
  const GapEstimate estimate = estimate_of(paper_experiment());
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash);
  EXPECT_FALSE(estimate.smallest_visible_gap > estimate.gap) << estimate.smallest_visible_gap;
}

/// The application example of the source paper with its load friction read as an acceleration.
TEST(ToldEvents, ALoadThatCoastsThroughTheGapIsSaidToDoSo) {
  TestDrive drive;
  drive.d2 = 3.073e-5, drive.Fc2 = 4.39e-5;
  TestEncoder encoder;
  encoder.duration = 40.0, encoder.step = 4e-6;
  const TestRecording recording = record(drive, sine(0.5, 0.1), encoder);
  const GapEstimate bank = estimate_of(recording), one = estimate_of(recording, {.bound = 100.0});
  for (const GapEstimate& estimate : {bank, one}) {
    ASSERT_EQ(estimate.verdict, GapVerdict::kInconclusive) << estimate.brief_report();
    EXPECT_THAT(estimate.reason.text(), HasSubstr("coasts through the gap before the motor turns"));
    EXPECT_THAT(estimate.reason.text(), Not(HasSubstr("quanta")));
    EXPECT_THAT(estimate.reason.text(), Not(HasSubstr("use auto")));
  }
  EXPECT_THAT(one.reason.text(), HasSubstr("nor does auto"));
  for (const GapEvent& e : bank.events) {
    EXPECT_TRUE(std::isnan(e.t1) && std::isnan(e.x1_t1)) << "contact was lost before x1 turned";
    EXPECT_TRUE(std::isfinite(e.t2));
  }
}

}  // namespace
}  // namespace gapscope
