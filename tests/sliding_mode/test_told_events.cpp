#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gapscope/sliding_mode/detector.h"
#include "signals/signal_facts.h"
#include "sliding_mode/bound_map.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 15 bit, noise and a heavy load, whose passages show in the mean of the periods alone; x1 swings about 0.25
/// rad.
const TestRecording& of_a_coarse_encoder() {
  static const TestRecording recording = [] {
    TestDrive drive;
    drive.m1 = 4e-4, drive.m2 = 8.8e-4, drive.Km = 0.15;
    drive.d1 = 0.03, drive.d2 = 0.02, drive.Fc1 = 0.005, drive.Fc2 = 0.03;
    drive.k = 600.0, drive.gap = 0.008;
    TestEncoder encoder;
    encoder.rate = 2000.0, encoder.duration = 12.0, encoder.bits = 15, encoder.noise = 0.5;
    return record(drive, sine(0.8, 0.8), encoder);
  }();
  return recording;
}

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

TEST(ToldEvents, LieOnTheTraceOfTheirRecordingAlsoThoseOfAMeanPeriod) {
  for (const bool coarse : {true, false}) {
    const TestRecording& recording = coarse ? of_a_coarse_encoder() : paper_experiment();
    const GapEstimate estimate = estimate_of(recording);
    ASSERT_FALSE(estimate.events.empty()) << estimate.brief_report();
    for (const GapEvent& e : estimate.events) {
      if (!e.accepted) continue;
      EXPECT_EQ(e.periods > 1, coarse);
      for (const auto& [time, x1] : {std::pair(e.t1, e.x1_t1), std::pair(e.t2, e.x1_t2)}) {
        const double place = time / recording.dt, share = place - std::floor(place);
        const auto i = static_cast<std::size_t>(place);
        const double on_trace = std::lerp(recording.x1[i], recording.x1[i + 1], share);
        EXPECT_NEAR(x1, on_trace, 3.0 * recording.quantum) << "at " << time << " s, coarse: " << coarse;
      }
    }
  }
}

TEST(ToldEvents, OfAMeanPeriodAreToldOnceWithTheNumberOfPeriods) {
  const GapEstimate estimate = estimate_of(of_a_coarse_encoder());
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  std::map<int, int> used;
  for (const GapEvent& e : estimate.events) used[e.direction] += e.accepted;
  EXPECT_EQ(used, (std::map<int, int>{{-1, 1}, {1, 1}}));
  EXPECT_GE(estimate.events.front().periods, 7);
  EXPECT_THAT(estimate.reason.text(), HasSubstr("2 of 2 passages of the gap used in the mean of "));
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
  for (const TestRecording& recording : {of_a_coarse_encoder(), paper_experiment()}) {
    const GapEstimate estimate = estimate_of(recording);
    ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash);
    EXPECT_FALSE(estimate.smallest_visible_gap > estimate.gap) << estimate.smallest_visible_gap;
  }
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
