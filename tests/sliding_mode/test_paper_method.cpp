// The source paper's own method, S3 and S4 on one e_x, on recordings of the independent plant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/simulate.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Setting {
  double torque = 0.1;     ///< amplitude [N m]
  double frequency = 1.0;  ///< [Hz]
  double rate = 2500.0;    ///< [Hz]
  int bits = 20;
};

GapEstimate read(const independent_plant::BlindDrive& drive, const Setting& s, double bound) {
  independent_plant::BlindExcitation sine;
  sine.amplitude = s.torque / drive.torque_constant;
  sine.frequency = s.frequency;
  independent_plant::BlindOptions options;
  options.rate = s.rate;
  options.duration = 8.0 / s.frequency;
  options.tolerance = independent_plant::kFastTolerance;
  const Recording recording =
      simulate_blind(drive, sine, independent_plant::BlindSensor::with_bits(s.bits), options).recording;
  const MotorTrace trace = recording.motor_trace();
  return detect_gap({&trace, 1}, {.bound = bound});
}

void expect_read(const independent_plant::BlindDrive& drive, const Setting& s, double bound,
                 double tolerance) {
  const GapEstimate estimate = read(drive, s, bound);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_EQ(estimate.method, GapMethod::kPaper);
  EXPECT_NEAR(estimate.gap / drive.gap, 1.0, tolerance) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, drive.gap);
  EXPECT_GE(estimate.ci95.high, drive.gap);
}

TEST(PaperMethod, ABoundBetweenTheAccelerationsReadsTheExperiment) {
  for (const double rate : {1000.0, 2500.0, 10000.0})
    for (const double bound : {3.0, 4.0, 5.0}) {
      SCOPED_TRACE(::testing::Message() << rate << " Hz, L = " << bound);
      expect_read({}, {.rate = rate}, bound, 0.03);
    }
}

TEST(PaperMethod, TheExperimentIsReadWithStifferAndCoarserDrives) {
  for (const double stiffness : {1000.0, 5000.0}) {
    independent_plant::BlindDrive drive;
    drive.contact_stiffness = stiffness;
    expect_read(drive, {}, 4.0, 0.03);
  }
  for (const int bits : {18, 16}) expect_read({}, {.bits = bits}, 4.0, 0.03);
}

TEST(PaperMethod, ABoundBelowTheEngagedAccelerationReadsWhereTheErrorBendsAway) {
  // 2 Hz, 0.5 N m: before the reversal the engaged drive decelerates with up to 62 rad/s², more than k₂ = 44
  // of L = 40, so e_x is 1.6 mrad long when contact is lost; only its bend tells t1.
  for (const double stiffness : {200.0, 1000.0, 5000.0})
    for (const double rate : {2500.0, 5000.0, 10000.0, 20000.0}) {
      SCOPED_TRACE(::testing::Message() << stiffness << " N m/rad, " << rate << " Hz");
      independent_plant::BlindDrive drive;
      drive.contact_stiffness = stiffness;
      expect_read(drive, {.torque = 0.5, .frequency = 2.0, .rate = rate}, 40.0, 0.03);
    }
}

TEST(PaperMethod, ABoundAboveTheGapAccelerationShowsNoBeginningAndSaysSo) {
  for (const double bound : {15.0, 40.0, 100.0}) {
    const GapEstimate estimate = read({}, {}, bound);
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << bound;
    EXPECT_TRUE(std::isnan(estimate.gap));
    EXPECT_THAT(estimate.reason.text(), HasSubstr("no t1")) << bound;
    EXPECT_THAT(estimate.reason.text(), HasSubstr("at most the impact shows")) << bound;
    EXPECT_THAT(estimate.reason.text(), HasSubstr("try L between")) << bound;
  }
}

TEST(PaperMethod, WhereTheImpactAloneShowsItIsListedWithoutABegin) {
  const GapEstimate estimate = read({}, {}, 40.0);  // eight periods
  std::map<int, int> seen;
  for (const GapEvent& e : estimate.events) {
    EXPECT_FALSE(e.accepted);
    EXPECT_TRUE(std::isnan(e.t1) && std::isnan(e.x1_t1) && std::isnan(e.gap)) << e.t2;
    EXPECT_TRUE(std::isfinite(e.t2) && std::isfinite(e.x1_t2));
    // u leads x1 by a little more than a quarter of a period: x1 rises into an impact while u is positive.
    EXPECT_EQ(e.direction, std::sin(2.0 * kPi * e.t2) > 0.0 ? 1 : -1) << e.t2;
    ++seen[e.direction];
  }
  EXPECT_GE(seen[1], 6);
  EXPECT_GE(seen[-1], 6);
  for (const GapEvent& e : read({}, {}, 3.0).events)  // where the passages are read
    EXPECT_FALSE(e.remark.starts_with("no t1")) << e.t2;
}

TEST(PaperMethod, ABoundBelowTheEngagedAccelerationThroughoutIsToldAsSuch) {
  const GapEstimate estimate = read({}, {}, 1.0);
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_THAT(estimate.reason.text(), HasSubstr("below the engaged acceleration"));
}

TEST(PaperMethod, ABendThatACoarseEncoderHidesIsToldAsSuch) {
  const GapEstimate estimate = read({}, {.torque = 0.5, .frequency = 2.0, .bits = 15}, 40.0);
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_THAT(estimate.reason.text(), HasSubstr("it does not bend visibly"));
  EXPECT_THAT(estimate.reason.text(), Not(HasSubstr("higher bound"))) << "the bounds that read may be lower";
}

TEST(PaperMethod, NoMoreReversalsAreReadThanThereAre) {
  int read_ones = 0, all = 0;
  const std::string reason = read({}, {}, 3.0).reason.text();
  ASSERT_EQ(std::sscanf(reason.c_str(), "%d of %d reversals read", &read_ones, &all), 2) << reason;
  EXPECT_LE(read_ones, all);
}

TEST(PaperMethod, NoBoundReadsAGapWhereThereIsNone) {
  independent_plant::BlindDrive bonded, one_inertia, sticking;
  bonded.contact = independent_plant::ContactKind::kBonded;
  one_inertia.load = independent_plant::BlindLoad::kNone;
  one_inertia.motor_inertia *= 2.0;
  one_inertia.effects.motor.friction.level_nm = 0.05;
  sticking = one_inertia;
  sticking.effects.motor.friction.stiction_ratio = 0.6;
  sticking.effects.motor.friction.stribeck_speed_rad_s = 0.1;
  const Setting slow, fast{.torque = 0.5, .frequency = 2.0};
  for (const auto& [drive, s, bound] : {std::tuple{bonded, slow, 5.0},
                                        {bonded, fast, 40.0},
                                        {one_inertia, slow, 5.0},
                                        {sticking, fast, 40.0}})
    EXPECT_NE(read(drive, s, bound).verdict, GapVerdict::kBacklash) << bound << " " << s.torque;
}

}  // namespace
}  // namespace gapscope
