// When the input acts, as the recordings have it: at its row, or between the rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

ReferenceModel sought() {
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.02);
  estimate(model, kMotorDamping, 0.07);
  estimate(model, kMassRatio, 1.1);
  estimate(model, kLoadDamping, 0.04);
  estimate(model, kContactStiffness, 250.0);
  return model;
}

Recording recorded(int bits, double rate) {
  BlindRig rig;
  rig.sensor = independent_plant::BlindSensor::with_bits(bits);
  rig.options.rate = rate;
  return rig.recording();
}

Recording every_second_row(const Recording& r) {
  Recording half = r;
  half.dt = 2.0 * r.dt, half.u.clear(), half.x1.clear(), half.x2.clear(), half.mode.clear();
  for (std::size_t i = 0; i < r.size(); i += 2) half.u.push_back(r.u[i]), half.x1.push_back(r.x1[i]);
  return half;
}

/// The input of each row stands in the next one.
Recording one_row_late(Recording r) {
  for (std::size_t i = r.size(); --i > 0;) r.u[i] = r.u[i - 1];
  return r;
}

TEST(InputTiming, OfAnInputThatIsHeldFromItsRowOnIsZero) {
  const FitSummary f = fit_one(recorded(20, 2000.0), sought());
  EXPECT_FALSE(f.input_timing.is_off()) << f.full_report();
  EXPECT_NEAR(f.input_timing.early_rows, 0.0, 0.05);
  EXPECT_LT(f.input_timing.std_rows, 0.02);
  EXPECT_EQ(f.trust, FitTrust::kGood) << f.why;
}

TEST(InputTiming, OfEverySecondRowIsAQuarterOfARowEarly) {
  const Recording r = every_second_row(recorded(20, 2000.0));
  const FitSummary f = fit_one(r, sought());
  EXPECT_NEAR(f.input_timing.early_rows, 0.25, 3.0 * f.input_timing.std_rows);
  EXPECT_TRUE(f.input_timing.is_off()) << f.input_timing.std_rows;
  EXPECT_EQ(f.trust, FitTrust::kLimited);
  EXPECT_EQ(f.why.code(), "input_mistimed") << f.why;
  EXPECT_TRUE(contains(f, "gap", 0.0188)) << "the interval holds what that moves\n" << f.full_report();
}

TEST(InputTiming, OfAnInputThatStandsARowLateIsARowEarly) {
  const FitSummary f = fit_one(one_row_late(recorded(20, 2000.0)), sought());
  EXPECT_NEAR(f.input_timing.early_rows, 1.0, 0.2);
  EXPECT_NE(f.trust, FitTrust::kGood);
}

TEST(InputTiming, ThatACoarseEncoderDoesNotShowIsLeftOpenWithinARow) {
  const FitSummary f = fit_one(recorded(12, 1000.0), sought());
  EXPECT_FALSE(f.input_timing.is_off());
  EXPECT_LE(f.input_timing.open_rows(), 0.3);
  EXPECT_EQ(InputTiming().open_rows(), 0.0);
  EXPECT_FALSE(InputTiming().is_off());
}

}  // namespace
}  // namespace gapscope
