#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/recording/recording_file.h"
#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/as_stream.h"
#include "sliding_mode/frozen_search.h"
#include "sliding_mode/test_drive.h"
#include "support/data.h"

namespace gapscope {
namespace {

/// The same double, or both none.
void expect_same(double a, double b) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << ", " << b;
}

void expect_same(const GapEvent& a, const GapEvent& b) {
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.accepted, b.accepted);
  EXPECT_EQ(a.remark, b.remark);
  for (double GapEvent::*number : {&GapEvent::t1, &GapEvent::t2, &GapEvent::x1_t1, &GapEvent::x1_t2,
                                   &GapEvent::gap, &GapEvent::gap_uncorrected, &GapEvent::std})
    expect_same(a.*number, b.*number);
}

void expect_same(const Streamed& a, const Streamed& b) {
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) expect_same(a.events[i], b.events[i]);
  EXPECT_EQ(a.estimate.verdict, b.estimate.verdict);
  EXPECT_EQ(a.estimate.reason, b.estimate.reason);
  expect_same(a.estimate.gap, b.estimate.gap);
  expect_same(a.estimate.std, b.estimate.std);
  expect_same(a.estimate.smallest_visible_gap, b.estimate.smallest_visible_gap);
}

/// Where both read a gap, the stream and the detector that sees all of the recording read the same one.
TEST(StreamDetector, ReadsWhatTheWholeRecordingReadsWhateverThePiecesItComesIn) {
  std::size_t events = 0, both = 0;
  for (std::uint64_t seed = 910001; seed < 910008; ++seed) {
    independent_plant::BlindCase c =
        independent_plant::random_drive(seed, independent_plant::Waveform::kSine);
    c.options.tolerance = independent_plant::kFastTolerance;
    const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
    MotorTrace trace = run.recording.motor_trace();
    trace.quantum = c.sensor.quantum;
    const Streamed whole = as_stream(trace, trace.size());
    for (const std::size_t pause : {std::size_t{1}, std::size_t{997}})
      expect_same(as_stream(trace, pause), whole);
    events += whole.events.size();
    const GapEstimate batch = detect_gap({&trace, 1});
    if (whole.estimate.verdict != GapVerdict::kBacklash || batch.verdict != GapVerdict::kBacklash) continue;
    ++both;
    EXPECT_NEAR(whole.estimate.gap, batch.gap, batch.std + whole.estimate.std) << seed;
  }
  EXPECT_GT(events, 12u);
  EXPECT_GE(both, 2u);
}

TEST(StreamDetector, TellsNoGapOfRealRecordingsWithoutOne) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* file : {"emps/emps_train.csv", "emps/emps_pulses.csv"}) {
    const Recording recording = read_recording((testing::data_folder() / file).string());
    const Streamed s = as_stream(recording.motor_trace(), 100);
    expect_same(s, as_stream(recording.motor_trace(), 1));
    EXPECT_NE(s.estimate.verdict, GapVerdict::kBacklash) << file;
  }
}

TEST(StreamDetector, ReadsThePaperRigAsTheWholeRecordingDoes) {
  const TestRecording recording = paper_experiment(1, 0.4);
  const MotorTrace trace = recording.trace();
  const GapEstimate whole = detect_gap({&trace, 1});
  const Streamed s = as_stream(trace);
  ASSERT_EQ(s.estimate.verdict, GapVerdict::kBacklash) << s.estimate.brief_report();
  EXPECT_NEAR(s.estimate.gap / 0.0188, 1.0, 0.02);
  EXPECT_NEAR(s.estimate.gap, whole.gap, whole.std);
  EXPECT_NEAR(static_cast<double>(s.events.size()), static_cast<double>(whole.events.size()), 1.0);
  EXPECT_NEAR(s.learnt.half_period, 0.5, 0.01);
  EXPECT_LT(s.learnt.until, 3.5) << "two periods, and at most a quarter more";
}

TEST(StreamDetector, WhatComesLaterChangesNothingThatWasTold) {
  const TestRecording recording = paper_experiment(2, 0.4);
  MotorTrace trace = recording.trace();
  const Streamed whole = as_stream(trace);
  trace.x1 = trace.x1.first(trace.size() / 2), trace.u = trace.u.first(trace.size() / 2);
  StreamDetector detector(trace.start, trace.dt, trace.quantum);
  for (std::size_t i = 0; i < trace.size(); ++i) detector.push(trace.u[i], trace.x1[i]);
  const std::vector<GapEvent> told = detector.take();  // before it knows that no more comes
  ASSERT_GE(told.size(), 7u);
  for (std::size_t i = 0; i < told.size(); ++i) expect_same(told[i], whole.events[i]);
  EXPECT_LT(trace.time(trace.size() - 1) - told.back().t2, 0.5 + 0.375)
      << "no later than three quarters of 0.5 s";
  EXPECT_EQ(detector.learnt().floors, whole.learnt.floors);
}

TEST(StreamDetector, KeepsNoMoreThanItsWindow) {
  const TestRecording recording = paper_experiment(3);
  internal::sliding_mode::FrozenSearch search("", 0.0, recording.dt, recording.quantum, 3);
  std::size_t most = 0;
  for (int lap = 0; lap < 4; ++lap)
    for (std::size_t i = 0; i < recording.x1.size(); ++i) {
      search.push(recording.u[i], recording.x1[i]);
      if (search.has_learnt()) most = std::max(most, search.held());
    }
  EXPECT_EQ(search.samples(), 4 * recording.x1.size());
  EXPECT_LE(most, static_cast<std::size_t>(2.76 * 0.51 / recording.dt));
  EXPECT_GT(search.passages(), 60u);
  EXPECT_EQ(search.summary().passages.size(), 3u);
  EXPECT_NEAR(static_cast<double>(search.summary().facts.half_periods), 3.0, 1.0);
}

TEST(StreamDetector, OfRestOrNoiseSaysWhyNothingIsLearnt) {
  StreamDetector detector(0.0, 1e-3, 1e-5);
  for (int i = 0; i < 300000; ++i) detector.push(0.0, 1e-5 * (i % 2));
  detector.finish();
  EXPECT_FALSE(detector.has_learnt());
  EXPECT_TRUE(detector.take().empty());
  EXPECT_EQ(detector.estimate().verdict, GapVerdict::kInconclusive);
  EXPECT_NE(detector.estimate().reason.text().find("no motion above the encoder's noise"), std::string::npos);
}

TEST(TurnCounter, CountsStrokesOfAMotionThatWanders) {
  internal::sliding_mode::TurnCounter turns(0.6);
  for (int i = 0; i < 10000; ++i) turns.step(std::sin(2.0 * kPi * i / 1000.0) + 1e-3 * i);
  EXPECT_NEAR(static_cast<double>(turns.count()), 20.0, 1.0);
  internal::sliding_mode::TurnCounter still(0.6);
  for (int i = 0; i < 1000; ++i) still.step(0.25 * std::sin(0.1 * i));
  EXPECT_EQ(still.count(), 0u);
}

}  // namespace
}  // namespace gapscope
