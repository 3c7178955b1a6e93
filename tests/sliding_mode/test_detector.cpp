#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

GapEstimate detect(const TestRecording& recording, const DetectorOptions& options = {}) {
  const MotorTrace trace = recording.trace();
  return detect_gap({&trace, 1}, options);
}

TEST(Detector, ADefaultEstimateSaysThatItWasNotRun) {
  const GapEstimate estimate;
  EXPECT_EQ(estimate.verdict, GapVerdict::kNotRun);
  EXPECT_TRUE(std::isnan(estimate.gap));
  EXPECT_THAT(estimate.brief_report(), HasSubstr("not called"));
}

TEST(Detector, ThePapersExperimentIsReadWithinThreePercentAndTheIntervalHoldsTheTruth) {
  for (const double gap : {0.0188, 0.019})
    for (const double noise : {0.0, 0.4, 1.0}) {
      const GapEstimate estimate = detect(paper_experiment(1, noise, gap));
      ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
      EXPECT_NEAR(estimate.gap / gap, 1.0, 0.03) << estimate.brief_report();
      EXPECT_LE(estimate.ci95.low, gap);
      EXPECT_GE(estimate.ci95.high, gap);
      EXPECT_LT(estimate.ci95.high - estimate.ci95.low, 0.2 * gap) << "the interval says something";
    }
}

TEST(Detector, ThePapersRigIsReadAtOtherRatesAndFrequencies) {
  for (const double rate : {1000.0, 5000.0, 10000.0})
    for (const double frequency : {0.5, 1.0}) {
      TestEncoder encoder;
      encoder.rate = rate;
      encoder.duration = 6.0 / frequency;
      const GapEstimate estimate = detect(record(TestDrive{}, sine(0.5814, frequency), encoder));
      ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << rate << " Hz " << estimate.brief_report();
      EXPECT_NEAR(estimate.gap / 0.0188, 1.0, 0.03) << rate << " Hz, sine " << frequency << " Hz";
      EXPECT_LE(estimate.ci95.low, 0.0188) << rate << " Hz, sine " << frequency << " Hz";
      EXPECT_GE(estimate.ci95.high, 0.0188) << rate << " Hz, sine " << frequency << " Hz";
    }
}

TEST(Detector, SeveralSamplesThatShareACountDoNotMakeTheImpactLate) {
  TestDrive drive;  // 42 counts of gap; where an impact shows late, 7 % more were read
  drive.m1 = 4e-4, drive.m2 = 8.8e-4, drive.Km = 0.15, drive.d1 = 0.03, drive.d2 = 0.02, drive.Fc2 = 0.03;
  drive.k = 600.0, drive.gap = 0.008;
  for (const std::uint64_t seed : {1, 2}) {
    TestEncoder encoder;
    encoder.rate = 8000.0, encoder.bits = 15, encoder.noise = 0.05, encoder.seed = seed;
    const GapEstimate estimate = detect(record(drive, sine(0.8, 0.8), encoder));
    ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
    EXPECT_LE(estimate.ci95.low, drive.gap) << estimate.brief_report();
    EXPECT_GE(estimate.ci95.high, drive.gap) << estimate.brief_report();
  }
}

TEST(Detector, AContactTooSoftForTheEncoderIsNeverReadTooSmall) {
  TestDrive
      drive;  // a light load behind a soft contact: what of it the counts hide was read as gap, 7 % less
  drive.m2 = 0.12 * drive.m1;
  drive.d1 = 0.12;
  drive.k = 60.0;
  drive.gap = 0.0068;
  for (const double amplitude : {0.4, 0.5}) {
    drive.Fc2 = 0.096 * amplitude;
    TestEncoder encoder;
    encoder.duration = 2.5;
    const GapEstimate fine = detect(record(drive, sine(amplitude, 2.83), encoder));
    ASSERT_EQ(fine.verdict, GapVerdict::kBacklash) << fine.brief_report();
    EXPECT_NEAR(fine.gap / drive.gap, 1.0, 0.02) << fine.brief_report();
    encoder.bits = 17;
    const GapEstimate coarse = detect(record(drive, sine(amplitude, 2.83), encoder));
    if (coarse.verdict != GapVerdict::kBacklash) continue;
    EXPECT_LE(coarse.ci95.low, drive.gap) << coarse.brief_report();
    EXPECT_GE(coarse.ci95.high, drive.gap) << coarse.brief_report();
  }
}

TEST(Detector, AContactThatACoarseEncoderHardlyShowsIsToldWithLimitedTrust) {
  TestDrive drive;
  drive.gap = 0.019;
  drive.x1 = 0.002;
  drive.k = 100.0;
  TestEncoder encoder;
  encoder.bits = 14;
  encoder.rate = 1000.0;
  encoder.duration = 5.0;
  const GapEstimate estimate = detect(record(drive, sine(0.5814, 1.0), encoder));
  EXPECT_EQ(estimate.trust, GapTrust::kLimited) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, drive.gap);
  EXPECT_GE(estimate.ci95.high, drive.gap);
  ASSERT_FALSE(estimate.warnings.empty());
  EXPECT_EQ(estimate.warnings.front().code(), "gap_uncertain");
  EXPECT_THAT(estimate.warnings.front().text(), HasSubstr(" counts wide, and about "));
}

TEST(Detector, ALoadThatOvertakesTheMotorIsNotReadAsAGap) {
  TestDrive drive;  // hardly any friction on the load: it coasts through the gap, the source's step S5 reads
                    // 0.04 rad
  drive.Fc2 = 0.002;
  drive.d2 = 0.005;
  const GapEstimate estimate = detect(record(drive, sine(0.5814, 1.0), {}));
  if (estimate.verdict == GapVerdict::kBacklash) {
    EXPECT_LE(estimate.ci95.low, 0.0188);
    EXPECT_GE(estimate.ci95.high, 0.0188);
  } else {
    EXPECT_FALSE(estimate.reason.empty());
  }
  EXPECT_NE(estimate.verdict, GapVerdict::kNone);
}

TEST(Detector, TheAutoEstimateWarnsWhenThePapersBoundWouldHaveMissedThePassages) {
  const TestRecording recording = paper_experiment();
  EXPECT_TRUE(detect(recording).warnings.empty());
  EXPECT_TRUE(detect(recording, {.paper_bound = 4.0}).warnings.empty());
  const GapEstimate estimate = detect(recording, {.paper_bound = 100.0});
  ASSERT_EQ(estimate.warnings.size(), 1u);
  EXPECT_THAT(estimate.warnings[0].text(), HasSubstr("L = 100"));
}

TEST(Detector, EveryPassageIsListedInOrderWithItsTimesAndTracesAreAsLongAsTheRecording) {
  const TestRecording recording = paper_experiment();
  const GapEstimate estimate = detect(recording);
  int accepted = 0;
  for (const GapEvent& event : estimate.events) {
    if (!event.accepted) {
      EXPECT_FALSE(event.remark.empty());
      continue;
    }
    ++accepted;
    EXPECT_LT(event.t1, event.t2);
    EXPECT_LT(event.t2 - event.t1, 0.2);
    EXPECT_GT(event.direction * (event.x1_t2 - event.x1_t1), 0.0);
    EXPECT_EQ(event.file, "test.csv");
  }
  EXPECT_EQ(accepted, 19) << "10 s at 1 Hz have 19 reversals after the first half period";
  EXPECT_TRUE(std::is_sorted(estimate.events.begin(), estimate.events.end(),
                             [](const auto& a, const auto& b) { return a.t2 < b.t2; }));
  ASSERT_EQ(estimate.traces.size(), 1u);
  EXPECT_EQ(estimate.traces[0].error.size(), recording.x1.size());
  EXPECT_EQ(estimate.traces[0].velocity.size(), recording.x1.size());
  EXPECT_GT(estimate.scale, 1.0);
}

TEST(Detector, NegatingTheRecordingNegatesTheDirectionsAndKeepsTheGap) {
  TestRecording recording = paper_experiment();
  const GapEstimate plain = detect(recording);
  for (double& x : recording.x1) x = -x;
  for (double& u : recording.u) u = -u;
  const GapEstimate mirrored = detect(recording);
  ASSERT_EQ(plain.events.size(), mirrored.events.size());
  for (std::size_t i = 0; i < plain.events.size(); ++i)
    EXPECT_EQ(plain.events[i].direction, -mirrored.events[i].direction);
  EXPECT_NEAR(plain.gap, mirrored.gap, 1e-9);
}

TEST(Detector, SeveralRecordingsAreCombinedNotConcatenated) {
  const TestRecording a = paper_experiment(1), b = paper_experiment(2, 0.5);
  const MotorTrace traces[] = {a.trace("a.csv"), b.trace("b.csv")};
  const GapEstimate both = detect_gap(traces);
  ASSERT_EQ(both.verdict, GapVerdict::kBacklash);
  EXPECT_EQ(both.events.size(), detect(a).events.size() + detect(b).events.size());
  EXPECT_EQ(both.traces.size(), 2u);
  EXPECT_NEAR(both.gap / 0.0188, 1.0, 0.03);
}

TEST(Detector, WhatRecordingsDisagreeByIsInTheIntervalOfBoth) {
  const TestRecording a = paper_experiment(1), less = paper_experiment(2, 0.0, 0.0180),
                      far = paper_experiment(2, 0.0, 0.0160);
  const MotorTrace near[] = {a.trace("a.csv"), less.trace("b.csv")};
  const GapEstimate both = detect_gap(near);
  ASSERT_EQ(both.verdict, GapVerdict::kBacklash);
  EXPECT_LT(both.ci95.low, 0.0180);
  EXPECT_GT(both.ci95.high, 0.0188);
  const MotorTrace apart[] = {a.trace("a.csv"), far.trace("b.csv")};
  const GapEstimate neither = detect_gap(apart);
  EXPECT_EQ(neither.trust, GapTrust::kLimited);
  EXPECT_LT(neither.ci95.low, 0.0160);
  EXPECT_GT(neither.ci95.high, 0.0188);
  ASSERT_FALSE(neither.warnings.empty());
  EXPECT_THAT(neither.warnings.front().text(), HasSubstr("the recordings read it differently"));
}

TEST(Detector, DrivesWithoutAGapAreNeverReportedWithOne) {
  TestDrive rigid;
  rigid.m1 += rigid.m2, rigid.d1 += rigid.d2, rigid.Fc1 = rigid.Fc2, rigid.m2 = 0.0;
  TestDrive compliant;
  compliant.gap = 0.0;
  TestDrive sticking = rigid;
  sticking.Fs1 = 1.6 * sticking.Fc1;
  TestDrive cogging = rigid;
  cogging.cogging = 0.02;
  for (const TestDrive& drive : {rigid, compliant, sticking, cogging}) {
    const GapEstimate estimate = detect(record(drive, sine(0.5814, 1.0), {}));
    EXPECT_NE(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
    EXPECT_FALSE(estimate.reason.empty());
    if (estimate.verdict == GapVerdict::kNone) {
      EXPECT_GT(estimate.smallest_visible_gap, 0.0);
    }
  }
}

TEST(Detector, NoneSaysForWhichLoadsItHoldsAndLeavesOnlySmallGapsOpen) {
  TestDrive rigid;
  rigid.m1 += rigid.m2, rigid.d1 += rigid.d2, rigid.Fc1 = rigid.Fc2, rigid.m2 = 0.0;
  const GapEstimate estimate = detect(record(rigid, sine(0.5814, 1.0), {}));
  ASSERT_EQ(estimate.verdict, GapVerdict::kNone) << estimate.brief_report();
  EXPECT_THAT(estimate.reason.text(), HasSubstr("0.2 of the motor's inertia"));
  EXPECT_LT(estimate.smallest_visible_gap, 0.019);
}

TEST(Detector, AMotorThatWandersUnderAnUnsymmetricalInputIsStillJudged) {
  TestDrive rigid;
  rigid.m1 += rigid.m2, rigid.Fc1 = 0.02, rigid.m2 = 0.0;
  const TestRecording recording =
      record(rigid, [](double t) { return sine(0.4, 1.0)(t) + sine(0.3, 2.0)(t + 0.1); }, {});
  ASSERT_GT(std::abs(recording.x1.back() - recording.x1.front()), 0.3) << "it does not wander";
  const GapEstimate estimate = detect(recording);
  EXPECT_EQ(estimate.verdict, GapVerdict::kNone) << estimate.brief_report();
}

TEST(Detector, BadDataIsAVerdictWithAReasonNeverAnException) {
  struct Bad {
    const char* what;
    std::vector<double> x1;
    const char* reason;
  };
  std::vector<double> ramp(5000), noise(5000);
  auto generator = random_stream(1, "bad data");
  for (std::size_t i = 0; i < ramp.size(); ++i)
    ramp[i] = 1e-3 * static_cast<double>(i), noise[i] = normal(generator);
  const std::vector<Bad> table{{"nothing", {}, "too short"},
                               {"standing still", std::vector<double>(5000, 0.3), "no motion"},
                               {"noise", noise, "noise"},
                               {"a ramp", ramp, "no periodic motion"}};
  for (const Bad& bad : table) {
    const MotorTrace trace{"bad.csv", 0.0, 1e-3, {}, bad.x1, 0.0};
    for (const double bound : {0.0, 5.0}) {
      const GapEstimate estimate = detect_gap({&trace, 1}, {.bound = bound});
      EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << bad.what;
      EXPECT_THAT(estimate.reason.text(), HasSubstr(bad.reason)) << bad.what;
      EXPECT_TRUE(std::isnan(estimate.gap)) << bad.what;
    }
  }
  EXPECT_EQ(detect_gap({}).verdict, GapVerdict::kInconclusive);
}

TEST(Detector, TheSameRecordingGivesTheSameAnswerEveryTime) {
  const TestRecording recording = paper_experiment(4, 0.7);
  const GapEstimate a = detect(recording), b = detect(recording);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.std, b.std);
  EXPECT_EQ(a.brief_report(), b.brief_report());
}

/// Positions of a coarse encoder that nobody declared.
Recording coarsely_read(double quantum, double amplitude) {
  Recording r;
  r.dt = 1e-3;
  for (int i = 0; i < 8000; ++i) {
    const double t = r.dt * i;
    r.u.push_back(0.6 * std::sin(2.0 * kPi * t));
    r.x1.push_back(quantum * std::nearbyint(amplitude * std::sin(2.0 * kPi * t - 1.0) / quantum));
  }
  return r;
}

TEST(Detector, SaysNothingOfAMotionOfTwoCounts) {
  for (const double amplitude : {0.5, 0.9, 1.4}) {  // of a count
    const Recording r = coarsely_read(0.06, 0.06 * amplitude);
    const MotorTrace trace[] = {r.motor_trace()};
    EXPECT_EQ(detect_gap(trace).verdict, GapVerdict::kInconclusive) << amplitude;
  }
}

}  // namespace
}  // namespace gapscope
