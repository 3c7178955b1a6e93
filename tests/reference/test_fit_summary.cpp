#include <gtest/gtest.h>

#include <cmath>

#include "gapscope/reference/fit_summary.h"

namespace gapscope {
namespace {

TEST(FitSummary, ADefaultOneSaysThatNothingWasRun) {
  const FitSummary summary;
  EXPECT_FALSE(summary.converged());
  EXPECT_TRUE(std::isnan(summary.rmse));
  EXPECT_EQ(summary.brief_report(), "fit: not run: fit() was not called.");
  EXPECT_NE(summary.full_report().find("not run"), std::string::npos);
  EXPECT_EQ(summary.find("gap"), nullptr);
}

TEST(FitSummary, ReportsNameWhatWasFixedAndWhatCouldNotBeDetermined) {
  FitSummary summary;
  summary.status = FitStatus::kConverged;
  summary.trust = FitTrust::kGood;
  summary.rmse = 1.5e-5;
  FittedParameter gap;
  gap.key = "gap", gap.unit = "rad", gap.value = 0.0188, gap.estimated = gap.identifiable = true;
  gap.ci95 = {0.0187, 0.0189};
  FittedParameter inertia;
  inertia.key = "motor_inertia", inertia.unit = "kg m^2", inertia.value = 1e-3;
  FittedParameter stiffness;
  stiffness.key = "contact_stiffness", stiffness.unit = "N m/rad", stiffness.value = 200.0;
  stiffness.estimated = true;
  summary.parameters = {gap, inertia, stiffness};
  summary.warnings = {Remark::said("something to know.")};
  EXPECT_NE(summary.brief_report().find("gap 0.0188 [0.0187, 0.0189]"), std::string::npos);
  EXPECT_NE(summary.brief_report().find("1 warning"), std::string::npos);
  const std::string full = summary.full_report();
  EXPECT_NE(full.find("fixed"), std::string::npos);
  EXPECT_NE(full.find("not identifiable"), std::string::npos);
  EXPECT_NE(full.find("warning: something to know."), std::string::npos);
  EXPECT_EQ(full.find("nan"), std::string::npos);
  summary.trust = FitTrust::kRejected;
  EXPECT_EQ(summary.brief_report().find("["), std::string::npos);
  EXPECT_EQ(summary.full_report().find("0.0187"), std::string::npos);
}

}  // namespace
}  // namespace gapscope
