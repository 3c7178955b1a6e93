// S1 to S6 as printed and nothing else, on recordings of the independent plant.
#include <gtest/gtest.h>

#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/simulate.h"

namespace gapscope {
namespace {

Recording experiment(const independent_plant::BlindDrive& drive = {}) {
  independent_plant::BlindExcitation sine;
  sine.amplitude = 0.1 / drive.torque_constant;
  sine.frequency = 1.0;
  independent_plant::BlindOptions options;
  options.rate = 2500.0;
  options.duration = 8.0;
  options.tolerance = independent_plant::kFastTolerance;
  return simulate_blind(drive, sine, independent_plant::BlindSensor::with_bits(20), options).recording;
}

GapEstimate read(const Recording& recording, double bound, EncoderSide encoder = EncoderSide::kMotor) {
  const MotorTrace trace = recording.motor_trace();
  return detect_gap({&trace, 1}, {.method = DetectorMethod::kLiteral, .encoder = encoder, .bound = bound});
}

TEST(LiteralMethod, IsTheMeanOfItsPassagesWithTheirScatterAndClaimsNothingElse) {
  const Recording recording = experiment();
  const GapEstimate estimate = read(recording, 4.0);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_EQ(estimate.method, GapMethod::kLiteral);
  EXPECT_NEAR(estimate.gap, 0.019, 0.05 * 0.019);
  double sum = 0.0, squares = 0.0;
  for (const GapEvent& e : estimate.events) sum += e.gap, squares += e.gap * e.gap;
  const auto n = static_cast<double>(estimate.events.size());
  EXPECT_GE(n, 14.0);
  EXPECT_NEAR(estimate.gap, sum / n, 1e-15);
  EXPECT_NEAR(estimate.std, std::sqrt((squares - sum * sum / n) / (n - 1.0)), 1e-9);
  EXPECT_TRUE(std::isnan(estimate.ci95.low) && std::isnan(estimate.ci95.high));
  EXPECT_TRUE(std::isnan(estimate.gap_at_most) && std::isnan(estimate.smallest_visible_gap));
  EXPECT_FALSE(estimate.lost_motion.read());
  EXPECT_TRUE(estimate.warnings.empty());
}

TEST(LiteralMethod, TakesTheSamplesThemselves) {
  const Recording recording = experiment();
  for (const GapEvent& e : read(recording, 4.0).events) {
    const auto at = [&](double t) {
      return recording.x1[static_cast<std::size_t>(std::lround((t - recording.start) / recording.dt))];
    };
    EXPECT_EQ(e.x1_t1, at(e.t1));
    EXPECT_EQ(e.x1_t2, at(e.t2));
    EXPECT_EQ(e.gap, std::abs(e.x1_t2 - e.x1_t1));
    EXPECT_EQ(e.direction, std::sin(2.0 * kPi * e.t2) > 0.0 ? 1 : -1);
    EXPECT_TRUE(e.accepted && std::isnan(e.std) && e.remark.empty());
  }
}

TEST(LiteralMethod, ABoundThatShowsImpactsAloneReadsNothingAndSaysHowMuchWasThere) {
  const GapEstimate estimate = read(experiment(), 40.0);
  EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(estimate.reason.code(), "passages_as_printed");
  EXPECT_TRUE(std::isnan(estimate.gap));
  EXPECT_TRUE(estimate.events.empty());
}

/// S1 to S6 have no step that asks whether there is a gap: a lone motor whose acceleration exceeds k2 for a
/// part of each half period throws e_x as a passage does.
TEST(LiteralMethod, TakesAGapForGranted) {
  independent_plant::BlindDrive bonded, lone;
  bonded.contact = independent_plant::ContactKind::kBonded;
  lone.load = independent_plant::BlindLoad::kNone;
  for (const double bound : {3.0, 40.0})
    for (const auto& drive : {bonded, lone})
      EXPECT_EQ(read(experiment(drive), bound).verdict, GapVerdict::kInconclusive) << bound;
  EXPECT_EQ(read(experiment(lone), 6.0).verdict, GapVerdict::kBacklash);
}

TEST(LiteralMethod, SaysWhatIsTheMatterWithARecordingAndWithAnEncoderOnTheLoad) {
  Recording still = experiment();
  std::fill(still.x1.begin(), still.x1.end(), 0.0);
  EXPECT_EQ(read(still, 4.0).reason.code(), "no_motion");
  EXPECT_EQ(detect_gap({}, {.method = DetectorMethod::kLiteral, .bound = 4.0}).reason.code(), "no_recording");
  const GapEstimate on_load = read(experiment(), 4.0, EncoderSide::kLoad);
  EXPECT_EQ(on_load.method, GapMethod::kLiteral);
  EXPECT_EQ(on_load.reason.code(), "encoder_on_load");
}

}  // namespace
}  // namespace gapscope
