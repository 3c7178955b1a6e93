#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/comparison.h"

namespace gapscope {
namespace {

GapEstimate model_free(double gap, double std) {
  GapEstimate e;
  e.verdict = GapVerdict::kBacklash;
  e.gap = gap;
  e.std = std;
  return e;
}

FitSummary reference(double gap, double std, bool identifiable = true) {
  FitSummary f;
  f.status = FitStatus::kConverged;
  f.trust = FitTrust::kGood;
  FittedParameter p;
  p.key = "gap";
  p.value = gap;
  p.std = std;
  p.estimated = true;
  p.identifiable = identifiable;
  f.parameters.push_back(p);
  return f;
}

TEST(Comparison, AgreesUpToTheJointIntervalAndNotBeyond) {
  const double joint = std::hypot(3e-4, 4e-4);  // 5e-4
  const Comparison within = compare(model_free(0.02 + 1.95 * joint, 3e-4), reference(0.02, 4e-4));
  EXPECT_NEAR(within.joint_std, 5e-4, 1e-18);
  EXPECT_NEAR(within.difference, 1.95 * joint, 1e-15);
  EXPECT_EQ(within.agree, true);
  EXPECT_EQ(compare(model_free(0.02 - 1.97 * joint, 3e-4), reference(0.02, 4e-4)).agree, false);
}

TEST(Comparison, SaysNothingWhereEitherEstimateIsMissing) {
  GapEstimate none = model_free(0.02, 1e-4);
  none.verdict = GapVerdict::kNone;
  EXPECT_TRUE(std::isnan(compare(none, reference(0.02, 1e-4)).difference));
  EXPECT_FALSE(compare(none, reference(0.02, 1e-4)).agree.has_value());
  EXPECT_FALSE(compare(model_free(0.02, 1e-4), FitSummary()).agree.has_value());
  EXPECT_FALSE(compare(model_free(0.02, 1e-4), reference(0.02, kNaN, false)).agree.has_value());
}

TEST(Comparison, ARejectedReferenceIsNoNumberToCompareWith) {
  FitSummary rejected = reference(0.02, 1e-4);
  rejected.trust = FitTrust::kRejected;
  const Comparison c = compare(model_free(0.02, 1e-4), rejected);
  EXPECT_FALSE(c.agree.has_value());
  EXPECT_TRUE(std::isnan(c.difference));
}

TEST(Comparison, DoesNotComparePlayAtZeroTorqueWithAGap) {
  GapEstimate play = model_free(0.02, 1e-4);
  play.quantity = GapQuantity::kPlayAtZeroTorque;
  EXPECT_TRUE(std::isnan(compare(play, reference(0.02, 1e-4)).difference));
}

TEST(Comparison, MapWidthIsTheDistanceOfTheFlanksWhateverRingsOnThem) {
  Recording r;
  for (int i = 0; i < 1000; ++i) {
    const double flank = i % 500 < 240 ? 0.01 : i % 500 < 480 ? -0.01 : 0.0;  // and 4 % of crossing
    r.x2.push_back(0.3 * i);
    r.x1.push_back(0.3 * i + flank + (i % 50 == 0 ? 0.004 : 0.0));
  }
  EXPECT_NEAR(map_width({&r, 1}), 0.02, 1e-12);
  r.x2.clear();
  EXPECT_TRUE(std::isnan(map_width({&r, 1})));
}

}  // namespace
}  // namespace gapscope
